# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The memory that FCL's InterpMotion reads and never wrote: what it finds there is set here."""

from __future__ import annotations

import ctypes
import sys
from functools import cache

import numpy as np

#: Bytes of FCL 0.7's InterpMotion, the object of CCDM_LINEAR: of all sizes from 24 to 2024, only
#: stale blocks of this size change answers.
#: valgrind reports no other uninitialised memory that conservative advancement reads, on the heap
#: or the stack.
MOTION_BYTES = 504
#: bytes that an InterpMotion finds; 0x7F makes numbers of 1e306
HEAP = {
    "zero": 0x00,
    "filled": 0x7F,
}


def fill_motions(fill: int) -> None:
    """Leave two blocks of this byte where malloc will look first for the two InterpMotions of the
    next call (1 us).

    glibc reuses the block of a size that was freed last.
    """
    libc = _libc()
    blocks = [libc.malloc(MOTION_BYTES), libc.malloc(MOTION_BYTES)]
    for block in blocks:
        libc.memset(block, fill, MOTION_BYTES)
    for block in blocks:
        libc.free(block)


@cache
def _libc():
    libc = ctypes.PyDLL(None)
    libc.malloc.restype, libc.malloc.argtypes = ctypes.c_void_p, [ctypes.c_size_t]
    libc.memset.restype, libc.memset.argtypes = (
        ctypes.c_void_p,
        [
            ctypes.c_void_p,
            ctypes.c_int,
            ctypes.c_size_t,
        ],
    )
    libc.free.restype, libc.free.argtypes = None, [ctypes.c_void_p]
    return libc


@cache
def repeatable(fcl) -> bool:
    """Whether `fill_motions` determines the answer here, tested by a rotating cube with our
    stale memory and with zeroed memory.
    """
    if sys.platform != "linux":
        return False
    request = fcl.ContinuousCollisionRequest(
        num_max_iterations=10,
        ccd_motion_type=fcl.CCDMotionType.CCDM_LINEAR,
        ccd_solver_type=fcl.CCDSolverType.CCDC_NAIVE,
    )
    stop, at_b = fcl.Transform(np.array([0.8, 0, 0, 0.6]), np.array([5.0, 0, 0])), fcl.Transform()
    a, b = (
        fcl.CollisionObject(fcl.Box(2, 2, 2), fcl.Transform(np.array([-5.0, 0, 0]))),
        fcl.CollisionObject(fcl.Box(2, 2, 2), at_b),
    )
    times = []
    for fill in (HEAP["filled"], HEAP["zero"]):
        result = fcl.ContinuousCollisionResult()
        fill_motions(fill)
        fcl.continuousCollide(a, stop, b, at_b, request, result)
        times.append(result.time_of_contact)
    return times[0] != times[1] and abs(times[1] - 1 / 3) < 1e-9
