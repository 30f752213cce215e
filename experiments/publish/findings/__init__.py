"""results/README.md: what the runs say of each claim of the article and of each engine, computed
from their rows.

No figure and no verdict is typed. runs.py makes rates and ratios of rows, ends.py asks OFG what the
rows do not hold, claims/ has a function for each claim, by section of the article, engines.py a
section for each engine, page.py puts them together. objections.py makes results/OBJECTIONS.md. What
is missing is said on the page, and stops nothing.
"""

from . import objections
from .page import page
from .runs import Runs

__all__ = ["Runs", "objections", "page"]
