# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Draws one case of each family: python -m experiments.publish.gallery.draw
experiments/cases/families/figures

A is blue, B orange (a pair that colour-blind readers tell apart). A moving A is solid at the start,
pale later; a straight arrow is its displacement, a curved one its turn.
"""

from __future__ import annotations

import io
import sys
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib
import numpy as np
import trimesh
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from experiments.cases.case import Case
from experiments.cases.families import scenarios
from ofg import Body, Motion, Pose

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402  (the backend comes first)

BLUE, ORANGE, INK = "#0072B2", "#E69F00", "#222222"
PANEL, DPI, FINE = (2.6, 2.2), 110, 3  # inches, dots per inch, rendered dots per dot


@dataclass(frozen=True)
class View:
    """Which case shows a family best: its level, the tags it must have, the direction it is seen
    from, and how the second panel magnifies the contact (0: no second panel).
    """

    level: float
    tags: dict = field(default_factory=dict)
    seen_from: tuple = (1.0, -2.2, 0.9)
    zoom: float = 0.0
    which: int = 0  # among the cases that fit


VIEWS = {
    "article_pieces": View(-0.01, {}, (0.6, -0.8, 2.0)),
    "article_table": View(0.1, {"aligned": "yes"}),
    "article_wall": View(10.0, {"place": "through"}, (2.2, -0.7, 0.5)),
    "both_moving": View(1.5, {"place": "onto", "turns about": "centre"}, (0.6, -0.8, 2.0), which=1),
    "concave_rotation": View(1.0, {"kind": "frame about a peg"}, (0.6, -0.8, 2.0)),
    "contact": View(30.0, {"place": "onto", "feature": "vertex-face"}, which=10),
    "contained": View(0.5, {"place": "inside"}, which=3),
    "deep": View(0.1, {"kind": "turned copy"}),
    "end_hit": View(0.01, {"feature": "vertex-face"}),
    "face_count": View(320.0, {"kind": "hulls"}),
    "far_from_origin": View(1e3, {"feature": "vertex-face"}),
    "feature_gap": View(0.1, {"feature": "edge-edge crossing"}, which=9),
    "full_turn": View(1.0, {"place": "in the way"}, (0.6, -0.8, 2.0)),
    "graze": View(0.1, {"feature": "vertex-face"}),
    "hooked_ls": View(0.1, {}, (0.6, -0.8, 2.0), which=3),
    "large_mesh": View(0.1),
    "linked_tori": View(0.05),
    "near_parallel": View(1e-7, {"kind": "hulls"}, which=2),
    "near_start": View(0.01, {"place": "towards", "angle": 45.0}),
    "parallel_faces": View(1e-2, which=4),
    "random_pose": View(0.75),
    "real_motion": View(1.5, {"kind": "surface", "place": "onto"}),
    "real_overlap": View(0.1, {"kind": "surface"}),
    "real_sweep": View(2.0, {"kind": "surface", "place": "onto"}, which=4),
    "rotational_contact": View(1.5, {"place": "onto"}, which=8),
    "scale": View(1.0, {"feature": "vertex-face"}),
    "screw_wall": View(10.0, {"place": "through", "turn": 3.0}, (2.2, -0.7, 0.5)),
    "sliver": View(10.0, {"kind": "needle on needle"}, which=1),
    "spin_clear": View(-1.0, {}, (0.6, -0.8, 2.0), which=2),
    "spin_side": View(2.0, {"place": "in the way"}, (0.6, -0.8, 2.0)),
    "thin_pair": View(20.0, {"place": "through", "kind": "plate"}, (2.2, -0.7, 0.5)),
    "thin_wall": View(10.0, {"place": "through"}, (2.2, -0.7, 0.5)),
    "through_hole": View(0.1, {"mover": "body"}, (2.0, -1.0, 1.2)),
    "tiny_huge": View(
        100.0, {"unit": "huge", "feature": "vertex-face"}, (1.0, -2.2, 0.4), zoom=40.0
    ),
}


def pictured(name: str) -> Case:
    """The first case of the family that fits its view; axis-aligned ones where the family has them,
    which are easier to read.
    """
    scenario, view = scenarios()[name], VIEWS.get(name, View(scenarios()[name].levels[0]))
    fits, aligned = [], []
    for index in range(300):
        case = scenario.case(1, view.level, index)
        if all(case.tags.get(k) == v for k, v in view.tags.items()):
            (aligned if case.tags.get("aligned") == "yes" else fits).append(case)
        if len(aligned) > view.which:
            return aligned[view.which]
    if len(aligned + fits) <= view.which:
        raise ValueError(
            f"Scenario '{name}': too few of 300 cases at level {view.level:g} have the tags"
            f" {view.tags} of its view in draw.py; correct the view."
        )
    return (aligned + fits)[view.which]


def caption(case: Case) -> str:
    return f"{case.id}: {case.query.a.name}, {case.query.b.name}"


def draw(name: str, path: Path) -> None:
    """Write one family's picture as a PNG with a palette of 128 colours."""
    case, view = pictured(name), VIEWS.get(name, View(0.0))
    panels = 2 if view.zoom else 1
    figure, axes = plt.subplots(1, panels, figsize=(PANEL[0] * panels, PANEL[1]), squeeze=False)
    toward = np.array(view.seen_from) / np.linalg.norm(view.seen_from)
    right = np.cross([0, 0, 1], toward)
    right /= np.linalg.norm(right)
    screen = np.array([right, np.cross(toward, right), toward])
    for ax, zoom in zip(axes[0], (0.0, view.zoom)):
        _panel(ax, case, screen, zoom)
    figure.subplots_adjust(0, 0, 1, 1, 0.02)
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI)
    plt.close(figure)
    note = PngInfo()
    note.add_text("case", caption(case))  # lets a test see that a picture is out of date
    Image.open(buffer).convert("RGB").quantize(128, dither=Image.Dither.NONE).save(
        path, optimize=True, pnginfo=note
    )


def _panel(ax, case: Case, screen: np.ndarray, zoom: float) -> None:
    q = case.query
    sides = ((q.b, q.pose_b, q.motion_b, ORANGE), (q.a, q.pose_a, q.motion, BLUE))
    movers = [side for side in sides if not side[2].rests]

    def place(
        body: Body, pose: Pose
    ) -> np.ndarray:  # relative to B, which may be far from the origin
        return (
            Pose(pose.quaternion, pose.position - q.pose_b.position).apply(body.vertices) @ screen.T
        )

    bodies = [(body, place(body, pose), colour) for body, pose, _, colour in sides]
    ghosts = [
        (body, place(body, motion.pose_at(pose, t)), colour)
        for body, pose, motion, colour in movers
        for t in np.linspace(0, 1, 9 if motion.angle > 1 else 5)[1:]
    ]
    tracks = []  # of each mover: where its arrow begins, and its arc
    for body, pose, motion, _ in movers:
        start = screen @ (pose.apply(motion.about[None])[0] - q.pose_b.position)
        turn = _arc(motion, body.radius) @ screen.T
        tracks.append((motion, start, start + turn if motion.angle else start[None]))
    places = [v for _, v, _ in bodies + ghosts] + [arc for *_, arc in tracks]
    every = np.concatenate([v[:, :2] for v in places])
    low, high = every.min(axis=0), every.max(axis=0)
    middle, half = (low + high) / 2, 0.54 * max((high - low) / PANEL) * np.array(PANEL)
    if zoom:
        middle, half = bodies[1][1][:, :2].mean(axis=0), half / zoom
    corner, step = middle - half, 2 * half[0] / (PANEL[0] * DPI * FINE)
    image = _render(bodies, ghosts, corner, step)
    ax.imshow(
        image,
        origin="lower",
        extent=np.stack([middle - half, middle + half], axis=1).ravel(),
        interpolation="antialiased",
    )
    for motion, start, arc in tracks:
        _arrows(ax, motion, start, arc, screen)
    ax.set(
        xlim=middle[0] + half[0] * np.array([-1, 1]),
        ylim=middle[1] + half[1] * np.array([-1, 1]),
        aspect="equal",
    )
    ax.axis("off")


def _render(bodies: list, ghosts: list, corner: np.ndarray, step: float) -> np.ndarray:
    """A picture (rows from the bottom, columns, rgb) by depth buffer; what is hidden shines through
    a little.
    """
    shape = (int(PANEL[1] * DPI * FINE), int(PANEL[0] * DPI * FINE))
    layers = [_layer(*each, corner, step, shape) for each in bodies]
    depth = np.stack([d for d, _ in layers])
    order, picture = np.argsort(depth, axis=0), np.ones((*shape, 3))
    for rank in range(len(layers)):  # from the back to the front
        for which, (d, colour) in enumerate(layers):
            here = (order[rank] == which) & np.isfinite(d)
            picture[here] = 0.22 * picture[here] + 0.78 * colour[here]
    front = depth.max(axis=0)
    for d, colour in (_layer(*each, corner, step, shape) for each in ghosts):
        weight = np.where(np.isfinite(d), np.where(d > front, 0.18, 0.07), 0.0)[..., None]
        picture = (1 - weight) * picture + weight * colour
    return picture


def _layer(
    body: Body, v: np.ndarray, colour: str, corner, step: float, shape
) -> tuple[np.ndarray, np.ndarray]:
    """Depth (-inf where there is nothing) and colour of one body; `v` its vertices on the screen,
    depth last.
    """
    depth, picture = np.full(shape, -np.inf), np.zeros((*shape, 3))
    rgb = np.array(matplotlib.colors.to_rgb(colour))
    v = np.column_stack([(v[:, :2] - corner) / step, v[:, 2] / step])
    mesh = trimesh.Trimesh(v, body.faces, process=False)
    for triangle, normal in zip(
        mesh.triangles, np.cross(*np.diff(mesh.triangles, axis=1).transpose(1, 0, 2))
    ):
        if normal[2] > 1e-9:
            light = 0.66 + 0.34 * np.clip(
                normal / np.linalg.norm(normal) @ [-0.4, 0.6, 0.7], -0.6, 1
            )
            _fill(triangle, normal, rgb * light, depth, picture)
    sharp = mesh.face_adjacency_angles > (0.12 if len(body.faces) < 400 else 0.35)
    for edge in mesh.face_adjacency_edges[sharp]:
        ends = v[edge]
        points = np.linspace(
            *ends, 2 + int(min(4000, 2 * np.abs(np.diff(ends[:, :2], axis=0)).max()))
        )
        for dx, dy in ((0, 0), (1, 0), (0, 1), (1, 1)):
            column, row = (points[:, :2].astype(int) + (dx, dy)).T
            inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
            row, column, z = row[inside], column[inside], points[inside, 2]
            # in front of its own faces, which are slanted across a pixel
            seen = z > depth[row, column] - 3.0
            picture[row[seen], column[seen]] = 0.35 * rgb
            depth[row[seen], column[seen]] = np.maximum(depth[row[seen], column[seen]], z[seen])
    return depth, picture


def _fill(triangle, normal, colour, depth, picture) -> None:
    low = np.maximum(np.floor(triangle[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(triangle[:, :2].max(axis=0)).astype(int) + 1, depth.shape[::-1])
    if (low >= high).any():
        return
    x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
    inside = np.ones(x.shape, bool)
    for p, q in zip(triangle, np.roll(triangle, -1, axis=0)):
        inside &= (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >= 0
    z = (
        triangle[0, 2]
        - (normal[0] * (x - triangle[0, 0]) + normal[1] * (y - triangle[0, 1])) / normal[2]
    )
    window = np.s_[low[1] : high[1], low[0] : high[0]]
    inside &= z > depth[window]
    depth[window][inside] = z[inside]
    picture[window][inside] = colour


def _arc(motion: Motion, radius: float) -> np.ndarray:
    """(40, 3) the turn as an arc about 0, at most nearly a full circle."""
    axis = motion.axis / np.linalg.norm(motion.axis)
    across = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.8 else [0, 1, 0])
    across /= np.linalg.norm(across)
    turn = np.linspace(0, min(motion.angle, 5.8), 40)[:, None]
    return 0.45 * radius * (np.cos(turn) * across + np.sin(turn) * np.cross(axis, across))


def _arrows(ax, motion: Motion, start: np.ndarray, arc: np.ndarray, screen: np.ndarray) -> None:
    style = dict(arrowstyle="-|>", color=INK, linewidth=1.1, shrinkA=0, shrinkB=0, mutation_scale=9)
    if motion.displacement.any():
        ax.annotate(
            "", (start + screen @ motion.displacement)[:2], start[:2], arrowprops=style, zorder=5
        )
    if motion.angle:
        ax.plot(arc[:-3, 0], arc[:-3, 1], color=INK, linewidth=1.1, zorder=5)
        ax.annotate("", arc[-1, :2], arc[-4, :2], arrowprops=style, zorder=5)


def main(folder: str) -> None:
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name in scenarios():
        draw(name, Path(folder) / f"{name}.png")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("Say where to: python -m experiments.publish.gallery.draw FOLDER")
    main(sys.argv[1])
