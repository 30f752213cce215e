"""The commands of ofg-bench, grouped by subject."""
