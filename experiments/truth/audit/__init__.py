"""Audits of the truth: corrupted certificates, independent judges, labels a second, aims of the
families.
"""
