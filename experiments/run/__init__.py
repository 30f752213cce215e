"""A run: from a configuration to labelled cases, answers and times in a folder of plain files."""
