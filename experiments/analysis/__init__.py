"""Derive outcomes, rates and costs from the rows of a run, and compare two runs."""
