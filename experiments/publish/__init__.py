# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""What others read: the report of a run, the findings over all runs, drawings."""
