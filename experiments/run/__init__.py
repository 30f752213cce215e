# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""A run: from a configuration to labelled cases, answers and times in a folder of plain files."""
