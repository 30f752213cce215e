"""Drills: the command line is run under faults of the machine and with faulty methods, and none of
them may become data.

`python -m experiments.drill` knows nothing of how a run works inside: it starts `ofg-bench run`,
does it harm, says the same command again where it stopped, and compares the files with those of a
run that was left alone.
"""
