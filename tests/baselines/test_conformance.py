# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Every method of the registry passes the conformance suite, except for the known defects listed
here.
"""

from functools import cache

import pytest

from baselines import conformance, registry

HEAD_ON, TURNS = "hits a head-on sweep at its time", "detects what a rotating bar hits"
TOWARDS = "detects a body that moves towards it"
CONTAINED = "contained bodies are detected by solid methods only"
B_TURNS, ABOUT = "detects what B hits as it rotates", "rotates about the given point"

# (method, property): what is wrong with the engine, measured. A defect that is gone fails the test
# (strict).
KNOWN_DEFECTS = {
    ("fcl-ccd-mesh", HEAD_ON): "the default request misses mesh pass-throughs: 37 of 40 cubes",
    (
        "fcl-ccd-convex",
        HEAD_ON,
    ): "with libccd it misses axis-aligned cubes head-on; GST_INDEP meets them",
    (
        "fcl-advancement-mesh",
        HEAD_ON,
    ): "conservative advancement on meshes misses pass-throughs at any setting",
    (
        "fcl-advancement-mesh",
        TURNS,
    ): "conservative advancement on meshes misses pass-throughs at any setting",
    ("fcl-ccd-mesh", TOWARDS): "the default request misses mesh pass-throughs, whoever moves",
    ("fcl-ccd-convex", TOWARDS): "with libccd it misses axis-aligned cubes head-on, whoever moves",
    **{
        (
            "fcl-advancement-mesh",
            title,
        ): "conservative advancement on meshes misses pass-throughs at any setting"
        for title in (TOWARDS, B_TURNS, ABOUT)
    },
    **{
        (
            f"bullet-{cast}-cast",
            CONTAINED,
        ): "it wants bodies that do not overlap at the start, as Bullet says"
        for cast in ("subsimplex", "gjk")
    },
    ("ofg", TURNS): (
        "as the article has it, virtual edges are chords: at 170 degrees they cut through the"
        " circle"
    ),
    ("brute-force", TURNS): "its virtual edges are chords, as OFG's",
    ("ofg", ABOUT): (
        "virtual edges are chords: about a point ten lengths off the arc leaves them by more than"
        " the cube's size"
    ),
    ("brute-force", ABOUT): "its virtual edges are chords, as OFG's",
    ("ofg", HEAD_ON): "where the faces at the end of the step meet, the article's time is 1",
    **{
        ("ofg-article", title): "step 1 at the start pose rejects what moves fast"
        for title in (HEAD_ON, TOWARDS)
    },
    ("ofg-article", TURNS): "virtual edges are chords: at 170 degrees they cut through the circle",
    (
        "ofg-article",
        ABOUT,
    ): "virtual edges are chords: about a point ten lengths off the arc leaves them",
}

# Asked with other parameters than the default, which would take minutes.
QUICKER = {name: f"{name} max_iterations=1000" for name in ("ipctk-ccd", "ipctk-ccd-exact")}


@cache
def results(name: str) -> dict:
    (method,) = registry.make(QUICKER.get(name, name))
    return {title: (ok, detail) for title, ok, detail in conformance.check(method)}


def _cases():
    for name in registry.methods():
        for title, _ in conformance.PROPERTIES:
            defect = KNOWN_DEFECTS.get((name, title))
            marks = [pytest.mark.xfail(strict=True, reason=defect)] if defect else []
            yield pytest.param(name, title, id=f"{name}: {title}", marks=marks)


@pytest.mark.parametrize("name, title", list(_cases()))
def test_property(name, title):
    missing = registry.available(registry.methods()[name])
    if missing:
        pytest.skip(missing)
    ok, detail = results(name)[title]
    assert ok, detail


def test_every_known_defect_names_a_method_and_a_property():
    titles = {title for title, _ in conformance.PROPERTIES}
    assert all(name in registry.methods() and title in titles for name, title in KNOWN_DEFECTS)
