# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Everything timed in C++: OFG and the engines as libraries, on the same certified cases.

    ofg-bench native [RUN]

cells of a run (certified.py) or of hulls by size (synthetic.py, further.py), measured
(measuring.py), compared by class of build (classes.py, summary.py) and written (page.py,
saving.py). Verified OFG is put over the engines (ratios.py), its targets (targets.py) and what its
preparation costs (preparation.py).
"""
