# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Studies that are not runs of cases: sizes and k, choice of units, stepping, the native lane."""
