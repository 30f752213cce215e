# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Errors of methods that cannot answer a query."""


class Unsupported(Exception):
    """Raised by `prepare` with the reason why a method cannot answer a query. It never counts as
    a miss.
    """


class MissingEngine(ImportError):
    """The engine's package is not installed; the message tells how to install it."""
