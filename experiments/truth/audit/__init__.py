# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Audits of the truth: corrupted certificates, independent judges, labelling rate, aims of the
families.
"""
