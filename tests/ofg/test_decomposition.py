# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Decomposition: cached by content, the same for the same seed, and pieces that cover the body."""

import multiprocessing
import time

import numpy as np
import pytest
import trimesh

import ofg
from ofg import Body, Pose


@pytest.fixture(scope="module")
def hook():
    """An L of two boxes, as one closed concave mesh: a polygon extruded by hand."""
    outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]], float)
    cap = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
    n = len(outline)
    vertices = np.concatenate([np.c_[outline, np.zeros(n)], np.c_[outline, np.ones(n)]])
    sides = [[i, (i + 1) % n, n + (i + 1) % n] for i in range(n)] + [
        [i, n + (i + 1) % n, n + i] for i in range(n)
    ]
    return Body.mesh(vertices, np.concatenate([cap[:, ::-1], cap + n, sides]), "hook")


def test_pieces_are_kept_by_content_and_seed(hook, tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    first = ofg.decompose(hook)
    files = list(tmp_path.iterdir())
    assert len(files) == 1 and first.kind == "union" and len(first.pieces) >= 2
    written = files[0].stat().st_mtime_ns
    assert (
        ofg.decompose(Body.mesh(hook.vertices, hook.faces, "another name")).digest == first.digest
    )
    assert files[0].stat().st_mtime_ns == written
    # cut short: made anew, and equal, because CoACD is deterministic by seed
    files[0].write_bytes(files[0].read_bytes()[:40])
    assert ofg.decompose(hook).digest == first.digest
    ofg.decompose(hook, seed=1)
    assert len(list(tmp_path.iterdir())) == 2


def test_pieces_cover_the_body(hook, tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    union = ofg.decompose(hook)
    volume = sum(p.to_trimesh().volume for p in union.pieces)
    assert volume == pytest.approx(5.0, rel=0.05)


CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)


def pair(one, other):
    """Two boxes in one mesh, both outward."""
    hulls = [Body.convex(one), Body.convex(other)]
    faces = np.concatenate([hulls[0].faces, hulls[1].faces + 8])
    return Body.mesh(np.concatenate([h.vertices for h in hulls]), faces, "pair")


def test_a_shell_inside_another_costs_nothing(tmp_path, monkeypatch):
    """CoACD took more than 100 s for 24 faces; a shell with the solid on both sides is left out."""
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    start = time.monotonic()
    union = ofg.decompose(pair(CUBE * 2, CUBE), seconds=60)
    assert union.volume == pytest.approx(64) and time.monotonic() - start < 60


def test_shells_apart_are_all_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    assert ofg.decompose(pair(CUBE, CUBE * 0.01 + [9, 0, 0])).volume == pytest.approx(8 + 8e-6)


def test_it_ends_after_the_time_given_also_in_a_daemon(hook, tmp_path, monkeypatch):
    """Native code cannot be interrupted where it runs, and a daemon may not use multiprocessing."""
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    start = time.monotonic()
    with pytest.raises(ofg.BodyError, match="hook.*CoACD took more than 0.2 s.*larger threshold"):
        ofg.decompose(hook, seconds=0.2)
    assert time.monotonic() - start < 10 and not list(tmp_path.iterdir())
    with pytest.raises(ValueError, match="seconds"):
        ofg.decompose(hook, seconds=0)
    fork = multiprocessing.get_context("fork")
    process = fork.Process(target=ofg.decompose, args=(hook,), daemon=True)
    process.start()
    process.join(120)
    assert process.exitcode == 0 and len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize(
    "pieces, words",
    [
        ([CUBE], "volume of CoACD's pieces is 0.50"),
        ([CUBE, CUBE], "omit shell 2"),
        ([CUBE * 3], "another body"),
    ],
)
def test_pieces_that_are_another_body_are_an_error(tmp_path, monkeypatch, pieces, words):
    """CoACD may drop a shell without a word."""
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    monkeypatch.setattr(ofg.decomposition, "_run_apart", lambda *_, **__: pieces)
    with pytest.raises(ofg.BodyError, match=f"pair.*{words}.*threshold.*undivided"):
        ofg.decompose(pair(CUBE, CUBE + [9, 0, 0]))
    assert not list(tmp_path.iterdir())


def test_a_failure_of_coacd_is_said(hook, tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    monkeypatch.setattr(ofg.decomposition.sys, "executable", "/bin/false")
    with pytest.raises(ofg.BodyError, match="hook.*CoACD failed .exit code 1.*undivided"):
        ofg.decompose(hook)


def test_thinned_pieces_lie_inside():
    ball = trimesh.creation.icosphere(subdivisions=3)
    thin = ofg.decomposition.supports(np.array(ball.vertices), 100)
    assert len(thin) <= 106 and {tuple(v) for v in thin} <= {tuple(v) for v in ball.vertices}


def test_a_convex_body_is_its_own_decomposition(cube):
    assert ofg.decompose(cube) is cube


def test_the_wrong_piece_is_what_the_object_level_gets_wrong(cube):
    """A small body in the hook of another is nearest, by centres, to one piece and touches the
    other.
    """
    near, far = (
        Body.convex(cube.vertices * 0.5),
        Body.convex(cube.vertices * (4, 0.2, 0.2) + (5, 0, 2)),
    )
    union = Body.union([near, far])
    probe, pose = Body.convex(cube.vertices * 0.25), Pose(position=(1.3, 0, 1.7))
    assert not ofg.discrete(probe, union, pose)
    answer = ofg.discrete(probe, union, pose, concave="all-pairs")
    assert answer and answer.pieces == (0, 1)
    assert ofg.discrete(probe, union, pose, concave="undivided", k=24)
