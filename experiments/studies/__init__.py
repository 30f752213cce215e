"""Studies beside the runs, each with a command of its own."""
