"""Experiments that are no run of cases: sizes and k, choice of units, stepping, the native lane."""
