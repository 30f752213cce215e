"""Audits of the truth: corrupted certificates, independent judges, labelling rate, aims of the
families.
"""
