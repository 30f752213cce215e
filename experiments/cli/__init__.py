"""The command line; `runner.py` runs the stages of a run in order."""
