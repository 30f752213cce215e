# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Cases: the queries of the benchmark. Scenario families draw two bodies, their poses and a
motion, aimed at one difficulty.
"""
