"""The command line, and the order in which a run is made: `runner.py`."""
