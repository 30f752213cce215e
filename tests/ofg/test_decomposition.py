"""Decomposition: cached by content, the same for the same seed, and pieces that cover the body."""

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
    sides = [[i, (i + 1) % n, n + (i + 1) % n] for i in range(n)] + [[i, n + (i + 1) % n, n + i] for i in range(n)]
    return Body.mesh(vertices, np.concatenate([cap[:, ::-1], cap + n, sides]), "hook")


def test_pieces_are_kept_by_content_and_seed(hook, tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    first = ofg.decompose(hook)
    files = list(tmp_path.iterdir())
    assert len(files) == 1 and first.kind == "union" and len(first.pieces) >= 2
    written = files[0].stat().st_mtime_ns
    assert ofg.decompose(Body.mesh(hook.vertices, hook.faces, "another name")).digest == first.digest
    assert files[0].stat().st_mtime_ns == written
    files[0].write_bytes(files[0].read_bytes()[:40])  # cut short: made anew, and equal, because CoACD is deterministic by seed
    assert ofg.decompose(hook).digest == first.digest
    ofg.decompose(hook, seed=1)
    assert len(list(tmp_path.iterdir())) == 2


def test_pieces_cover_the_body(hook, tmp_path, monkeypatch):
    monkeypatch.setenv("OFG_CACHE", str(tmp_path))
    union = ofg.decompose(hook)
    volume = sum(p.to_trimesh().volume for p in union.pieces)
    assert volume == pytest.approx(5.0, rel=0.05)


def test_thinned_pieces_lie_inside():
    ball = trimesh.creation.icosphere(subdivisions=3)
    thin = ofg.decomposition.supports(np.array(ball.vertices), 100)
    assert len(thin) <= 106 and {tuple(v) for v in thin} <= {tuple(v) for v in ball.vertices}


def test_a_convex_body_is_its_own_decomposition(cube):
    assert ofg.decompose(cube) is cube


def test_the_wrong_piece_is_what_the_object_level_gets_wrong(cube):
    """A small body in the hook of another is nearest, by centres, to one piece and touches the other."""
    near, far = Body.convex(cube.vertices * 0.5), Body.convex(cube.vertices * (4, 0.2, 0.2) + (5, 0, 2))
    union = Body.union([near, far])
    probe, pose = Body.convex(cube.vertices * 0.25), Pose(position=(1.3, 0, 1.7))
    assert not ofg.discrete(probe, union, pose)
    answer = ofg.discrete(probe, union, pose, concave="all-pairs")
    assert answer and answer.pieces == (0, 1)
    assert ofg.discrete(probe, union, pose, concave="undivided", k=24)
