"""python -m experiments.cli: the command line where ofg-bench is not on the path."""

from .app import main

main()
