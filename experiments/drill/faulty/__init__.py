"""Faulty methods, one for each way of being faulty that we know; `methods.py` is the file a
configuration names.

Each must cost its own rows only. They are no attacks: a method is code that you run, with your
rights (SECURITY.md).
"""
