"""Studies that are not runs of cases: sizes and k, choice of units, stepping, the native lane."""
