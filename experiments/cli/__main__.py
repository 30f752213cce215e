# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""python -m experiments.cli: the command line if ofg-bench is not on the PATH."""

from .app import main

main()
