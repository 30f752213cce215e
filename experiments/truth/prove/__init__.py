# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The prover: it proposes a label and its certificate. A proposal counts only if the checker
accepts it.
"""
