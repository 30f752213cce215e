"""The stepping track: engines as simulators. Does a body that moves far in a step get past what it
had to hit?
"""
