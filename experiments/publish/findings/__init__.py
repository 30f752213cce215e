# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""results/README.md: the findings of the runs on each claim of the article and on each engine,
computed from the rows of the runs.

No figure and no verdict is typed. runs.py computes rates and ratios from rows, ends.py runs OFG for
what the rows do not contain, claims/ has a function per claim, grouped by section of the article,
engines.py writes a section per engine, and page.py assembles the page. objections.py writes
results/OBJECTIONS.md. The page lists missing runs and is written without them.
"""

from . import objections
from .page import page
from .runs import Runs

__all__ = ["Runs", "objections", "page"]
