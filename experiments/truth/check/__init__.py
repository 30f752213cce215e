"""The checker: it decides by the certificate alone, and imports neither the prover nor an
engine.
"""
