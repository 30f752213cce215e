# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Everything timed in C++: OFG and the engines as libraries, on the same certified cases.

    ofg-bench native [RUN | --concave]

cells of a run (certified.py), of hulls by size (synthetic.py, further.py) or of concave bodies
(concave.py), measured (measuring.py), compared by class of build (classes.py, summary.py) and
written (page.py, saving.py). Verified OFG is put over the engines (ratios.py), its targets
(targets.py) and what its preparation costs (preparation.py).
"""
