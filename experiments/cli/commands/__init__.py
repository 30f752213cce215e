"""The commands of ofg-bench, by what they are about."""
