# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The folder of a run: its files, their columns, and how they are written atomically and read as
data.
"""
