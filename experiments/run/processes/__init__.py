# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Worker processes: a method that crashes, hangs or exhausts the memory loses only its own row."""
