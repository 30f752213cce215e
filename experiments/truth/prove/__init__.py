"""The prover: it proposes a label and its certificate. A proposal counts only if the checker
accepts it.
"""
