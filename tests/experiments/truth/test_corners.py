# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Hard corners: labelled rightly, or uncertain with a reason; never wrong, never hanging."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from experiments.truth import label
from ofg import Body, Motion, Pose, Query

from .draw import single


def box(x, y, z):
    corners = [(i, j, k) for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)]
    return Body.convex(np.array(corners) * (x, y, z), "box")


def mesh_box(*size):
    m = trimesh.creation.box(size)
    return Body.mesh(m.vertices, m.faces, "mesh box")


def torus():
    m = trimesh.creation.torus(1.0, 0.3, major_sections=16, minor_sections=8)
    return Body.mesh(single(m.vertices), m.faces, "torus")


@pytest.mark.parametrize("power", (-30, -10, 0, 10, 30))
@pytest.mark.parametrize("gap", (2.0**-46, -(2.0**-46), 2.0**-49, -(2.0**-49)))
def test_gaps_of_1e_14_at_scales_of_1e_9_to_1e9(power, gap):
    size = 2.0**power
    a = box(size, size, size)
    truth = label(Query("overlap", a, a, Pose(), Pose(position=[size * (1 + gap), 0.25 * size, 0])))
    assert truth.label == ("clear" if gap > 0 else "hit")
    assert np.isclose(truth.gap, gap * size, rtol=0.05)


@pytest.mark.parametrize("offset", (1e6, 1e9))
def test_far_from_the_origin(offset):
    unit = box(1, 1, 1)
    for gap in (2.0**-20, -(2.0**-20)):
        truth = label(
            Query(
                "overlap",
                unit,
                unit,
                Pose(position=[offset] * 3),
                Pose(position=[offset + 1 + gap, offset, offset]),
            )
        )
        assert truth.label == ("clear" if gap > 0 else "hit") and np.isclose(
            truth.gap, gap, rtol=0.01
        )
    near, far = (
        label(
            Query(
                "motion",
                unit,
                unit,
                Pose(position=[p] * 3),
                Pose([0.5, 0.5, 0.25, 0], [p + 4, p, p]),
                Motion([10, 0, 0], [0, 1, 1], 20.0),
            )
        )
        for p in (0.0, offset)
    )
    assert (near.label, near.t_lo, near.t_hi) == (far.label, far.t_lo, far.t_hi)


@pytest.mark.parametrize("make", (box, mesh_box))
def test_a_wall_of_1e_9_at_speed_1e6(make):
    ball, wall = make(0.125, 0.125, 0.125), make(2.0**-30, 8, 8)
    for question, motion in (
        ("translation", Motion([2.0**20, 0.125, 0.25])),
        ("motion", Motion([2.0**20, 0.125, 0.25], [1, 1, 1], 50.0)),
    ):
        truth = label(
            Query(
                question,
                ball,
                wall,
                Pose([0.9, 0.1, 0.2, 0.3], [-(2.0**18), 0.1, 0]),
                Pose(),
                motion,
            )
        )
        assert (truth.label, truth.start, truth.end) == ("hit", "clear", "clear")
        assert abs(truth.t_lo - 0.25) < 2e-7 and truth.t_hi - truth.t_lo <= 1e-12


def test_a_hundred_turns_in_a_step():
    bar, unit = box(4, 0.25, 0.25), box(1, 1, 1)
    swept = label(
        Query(
            "motion",
            bar,
            unit,
            Pose(),
            Pose(position=[0, 2, 0]),
            Motion(axis=[0, 0, 1], angle=200 * np.pi),
        )
    )
    assert swept.label == "hit" and 1 / 800 < swept.t_lo < 1 / 400
    clear = label(
        Query(
            "motion",
            bar,
            unit,
            Pose(),
            Pose(position=[0, 3, 0]),
            Motion(axis=[0, 0, 1], angle=200 * np.pi),
        )
    )
    assert clear.label == "clear" and 0.9 * (
        2.5 - np.hypot(2, 0.125)
    ) < clear.gap <= 2.5 - np.hypot(2, 0.125)


@pytest.mark.parametrize(
    "body", (box(1, 1, 1), mesh_box(1, 1, 1), torus()), ids=("hull", "mesh", "torus")
)
def test_a_body_against_its_own_copy_in_place(body):
    pose = Pose([0.3, 0.2, 0.1, 0.9], [0.125, 0.25, 0.5])
    for question, motion in (
        ("overlap", Motion()),
        ("translation", Motion([1, 0, 0])),
        ("motion", Motion(axis=[0, 0, 1], angle=9.0)),
    ):
        truth = label(Query(question, body, body, pose, pose, motion))
        assert truth.label == truth.start == "hit"


@pytest.mark.parametrize("make", (box, mesh_box))
def test_faces_in_touch_are_clear_where_a_plane_proves_it_and_uncertain_for_meshes(make):
    """At rest, sliding along the common face, and spinning on it."""
    a = make(2, 2, 2)
    for question, motion in (
        ("overlap", Motion()),
        ("translation", Motion([0, 1, 0])),
        ("motion", Motion(axis=[1, 0, 0], angle=1.0)),
    ):
        truth = label(Query(question, a, a, Pose(), Pose(position=[2, 0, 0]), motion))
        if make is box:
            assert (truth.label, truth.touching) == ("clear", True)
        else:
            assert truth.label == "uncertain" and "touching" in truth.reason


@pytest.mark.parametrize("make", (box, mesh_box))
def test_face_on_impact_of_equal_boxes(make):
    a = make(2, 2, 2)
    truth = label(Query("translation", a, a, Pose(), Pose(position=[3, 0, 0]), Motion([2, 0, 0])))
    assert (truth.label, truth.start, truth.end) == ("hit", "clear", "hit")
    assert truth.t_lo <= 0.5 <= truth.t_hi <= 0.5 * (1 + 1e-12)


def test_nearly_flat_and_tiny_pieces():
    flat = Body.convex(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 2.0**-40]]) + 3)
    tiny = Body.convex(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 2.0**-30 - 2)
    body = Body.union([box(1, 1, 1), flat, tiny])
    probe = Body.union([box(0.125, 0.125, 0.125)])
    truth = label(
        Query("translation", body, probe, Pose(), Pose(position=[3.25, 3.25, 4]), Motion([0, 0, 2]))
    )
    assert truth.label == "hit" and abs(truth.t_lo - (1 - 0.0625) / 2) < 1e-9
    assert (
        label(Query("overlap", body, body, Pose(), Pose(position=[0.5, 0.25, 0.125]))).label
        == "hit"
    )


def test_containment_is_a_hit_unless_in_a_cavity():
    outer, inner = trimesh.creation.box((4, 4, 4)), trimesh.creation.box((3, 3, 3))
    hollow = Body.mesh(
        np.concatenate([outer.vertices, inner.vertices]),
        np.concatenate([outer.faces, inner.faces[:, ::-1] + len(outer.vertices)]),
        "hollow",
    )
    small = mesh_box(1, 1, 1)
    assert label(Query("overlap", small, mesh_box(4, 4, 4))).label == "hit"
    assert label(Query("overlap", box(1, 1, 1), mesh_box(4, 4, 4))).label == "hit"
    free = label(Query("overlap", small, hollow))
    assert free.label == "clear" and 0.98 < free.gap <= 1
    assert (
        label(Query("motion", small, hollow, motion=Motion([0.125, 0, 0], [1, 1, 0], 20.0))).label
        == "clear"
    )
    assert label(
        Query("translation", small, hollow, motion=Motion([2, 0, 0]))
    ).t_lo == pytest.approx(0.5)


def test_the_limit_of_effort_is_stated(monkeypatch):
    from experiments.truth.prove import prover

    monkeypatch.setattr(prover, "EFFORT", 2000.0)
    truth = label(
        Query(
            "motion",
            torus(),
            torus(),
            Pose(),
            Pose([1, 1, 0, 0], [1, 0, 0]),
            Motion([0, 0, 0.25], [0, 0, 1], 60.0),
        )
    )
    assert truth.label == "uncertain" and "effort limit" in truth.reason
