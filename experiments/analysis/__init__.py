# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Derive outcomes, rates and costs from the rows of a run, and compare two runs."""
