"""The folder of a run: its files, their columns, how they are written whole and read as data."""
