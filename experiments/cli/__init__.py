# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The command line; `runner.py` runs the stages of a run in order."""
