# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Tables in a Markdown page are taken from the run that the page is filled from, or from one that
the marker names.
"""

import pytest

from experiments.publish.readme import fill


def test_a_marker_may_name_another_run(tmp_path):
    for run in ("quick", "article"):
        (tmp_path / run / "tables").mkdir(parents=True)
        (tmp_path / run / "tables" / "misses.md").write_text(f"of {run}\n")
    page = (
        "<!-- table misses -->\nold\n<!-- end -->\n<!-- table misses of article -->\nold\n<!-- end"
        " -->\n"
    )
    filled = fill(page, tmp_path / "quick" / "tables")
    assert filled == page.replace("old", "of quick", 1).replace("old", "of article")
    assert fill(filled, tmp_path / "quick" / "tables") == filled
    with pytest.raises(ValueError, match="'misses', which the run does not have"):
        fill(page.replace("of article", "of other"), tmp_path / "quick" / "tables")
