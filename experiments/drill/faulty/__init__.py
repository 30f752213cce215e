# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Faulty methods, one for each known kind of fault; a configuration names the file `methods.py`.

Each may affect only its own rows. They are not attacks: a method is code that you run, with your
rights (SECURITY.md).
"""
