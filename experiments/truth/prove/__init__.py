"""The prover: it proposes a label and its certificate. Nothing it says counts before the checker
agrees.
"""
