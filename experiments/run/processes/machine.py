"""Faults of the machine: they end a run honestly and never become data."""

from __future__ import annotations

import errno

#: errors of the machine, whatever was asked; any other at the start is a folder that was badly
#: chosen
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
    """The machine failed (a full or failing disk, no memory, killed processes): the run stops and
    can go on later. The message says what failed and the remedy.
    """
