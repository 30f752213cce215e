# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Run CoACD in a separate process that can be terminated.

Usage: coacd_child.py SECONDS < IN.npz > OUT.npz

Native code that hangs cannot be interrupted from within its own process. This file is run as a
script and imports nothing from ofg, so that it starts fast.
"""

import io
import os
import signal
import sys

import numpy as np


def end_with_parent() -> None:
    """Terminate this process when its parent is killed (Linux; elsewhere the alarm ends it)."""
    if sys.platform == "linux":
        import ctypes

        pr_set_pdeathsig = 1
        ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def main(seconds: str) -> None:
    """Read a mesh from stdin, write its pieces to stdout; terminate after that many seconds."""
    end_with_parent()
    if hasattr(signal, "alarm"):
        # The default action of the alarm ends the process, also in native code.
        signal.alarm(int(float(seconds)) + 5)
    answer = os.dup(1)
    os.dup2(2, 1)  # what CoACD prints must not get into the archive
    import coacd

    coacd.set_log_level("error")
    with np.load(io.BytesIO(sys.stdin.buffer.read()), allow_pickle=False) as x:
        mesh = coacd.Mesh(x["vertices"], x["faces"])
        parts = coacd.run_coacd(
            mesh,
            threshold=float(x["threshold"]),
            max_convex_hull=int(x["max_pieces"]),
            seed=int(x["seed"]),
        )
    splits = np.cumsum([len(v) for v, _ in parts])[:-1] if parts else np.empty(0, int)
    vertices = np.concatenate([v for v, _ in parts]) if parts else np.empty((0, 3))
    stream = io.BytesIO()
    np.savez(stream, vertices=vertices, splits=splits)
    with open(answer, "wb") as pipe:
        pipe.write(stream.getvalue())


if __name__ == "__main__":
    main(*sys.argv[1:])
