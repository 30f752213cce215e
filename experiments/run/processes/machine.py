# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Faults of the machine: they end a run and never become data."""

from __future__ import annotations

import errno

#: errors of the machine at any time; any other error at the start means a badly chosen folder
ERRNOS = {
    errno.ENOSPC,
    errno.EDQUOT,
    errno.EIO,
    errno.EFBIG,
    errno.EMFILE,
    errno.ENFILE,
    errno.ENOMEM,
}


class MachineError(RuntimeError):
    """The machine failed (a full or failing disk, no memory, killed processes): the run stops
    and can be resumed. The message gives the fault and the remedy.
    """
