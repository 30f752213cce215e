# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The checker: it decides by the certificate alone, and imports neither the prover nor an
engine.
"""
