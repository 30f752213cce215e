# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The stepping track: engines as simulators. Does a body that moves far in a step pass its
obstacle?
"""
