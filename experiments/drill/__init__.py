# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Fault drills: the command line runs under faults of the machine and with faulty methods, none of
which may corrupt data.

`python -m experiments.drill` uses no internals of a run: it starts `ofg-bench run`, injects a
fault, repeats the command if it stopped, and compares the files with those of an undisturbed run.
"""
