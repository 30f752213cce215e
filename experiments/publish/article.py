# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Draw the figures of ofg/ARTICLE.md: python -m experiments.publish.article FOLDER

The coloured faces are computed for the case shown, by the core or by the article's steps; nothing
is sketched by hand.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

import ofg
from experiments.cases import families
from ofg import Body, Pose, Query

from .report.selection import trace

A, B, CHOSEN_A, CHOSEN_B = "#9ecae1", "#fdd0a2", "#08519c", "#d94801"


def case(scenario: str, level: float, **tags) -> Query:
    """The first axis-aligned case of a family with these tags."""
    family = families.get(scenario)
    drawn = (family.case(2004, level, i) for i in range(100))
    wanted = {"aligned": "yes", **tags}
    return next(c.query for c in drawn if all(c.tags.get(k) == v for k, v in wanted.items()))


def scene(
    query: Query, width: float, title: str, place=(1, 1, 1), seen_from=(18, -60), aside=(0, 0, 0)
) -> plt.Axes:
    """3D axes centred at the middle of A's path plus `aside`, extending `width` to each side, with
    the view direction (elevation, azimuth) in degrees.
    """
    ax = plt.gcf().add_subplot(*place, projection="3d", proj_type="ortho", computed_zorder=False)
    ax.set_title(title, fontsize=9)
    middle = query.pose_a.position + query.motion.displacement / 2 + aside
    for limits, c in zip((ax.set_xlim, ax.set_ylim, ax.set_zlim), middle):
        limits(c - width, c + width)
    ax.set_box_aspect((1, 1, 1), zoom=1.55)
    ax.set_axis_off()
    ax.view_init(*seen_from)
    return ax


def faces(
    ax, body: Body, pose: Pose, ids, colour: str, alpha: float, order: int, edge="#555555"
) -> None:
    corners = pose.apply(body.vertices)[body.faces[ids]]
    ax.add_collection3d(
        Poly3DCollection(
            corners, facecolors=colour, edgecolors=edge, linewidths=0.4, alpha=alpha, zorder=order
        )
    )


def whole(ax, body: Body, pose: Pose, colour: str, alpha: float, order: int) -> None:
    faces(ax, body, pose, slice(None), colour, alpha, order)


def selections(path: Path) -> None:
    """Steps 2 to 5: the k selected faces of each body for two values of k, at the start of the
    rotation, as in the article.
    """
    query = case("article_table", 0.1)
    start = Query("overlap", query.a, query.b, query.pose_a, query.pose_b)
    plt.figure(figsize=(7, 3.2))
    for i, k in enumerate((2, 8)):
        chosen = trace(start, {"k": k})
        ax = scene(query, 1.6, f"k = {k}", (1, 2, i + 1))
        whole(ax, query.b, query.pose_b, B, 0.25, 1)
        faces(ax, query.b, query.pose_b, chosen["b"], CHOSEN_B, 0.55, 2)
        whole(ax, query.a, query.pose_a, A, 0.25, 3)
        faces(ax, query.a, query.pose_a, chosen["a"], CHOSEN_A, 0.55, 4)
    save(path)


def virtual_edges(path: Path) -> None:
    """Moving objects, step 3: each selected vertex joined to its copy after the step."""
    query = case("article_wall", 10.0, place="through")
    end = query.motion.pose_at(query.pose_a, 1.0)
    plt.figure(figsize=(4.2, 3.6))
    ax = scene(query, 1.3, "the face, its copy, and the virtual edges")
    whole(ax, query.a, end, A, 0.6, 1)
    whole(ax, query.b, query.pose_b, B, 0.5, 2)
    whole(ax, query.a, query.pose_a, CHOSEN_A, 0.6, 4)
    chosen = trace(query, {"k": 8})["a"]
    vertices = query.a.vertices[np.unique(query.a.faces[chosen])]
    lines = np.stack([query.pose_a.apply(vertices), end.apply(vertices)], axis=1)
    ax.add_collection3d(Line3DCollection(lines, colors="#222222", linewidths=0.9, zorder=3))
    save(path)


def pieces(path: Path) -> None:
    """Concave objects: the pieces that the scheme selects, and the pieces that collide."""
    query = case("article_pieces", -0.01)
    picked, meeting = ofg.ask(query, k=12).pieces, ofg.ask(query, k=12, repairs="all").pieces
    plt.figure(figsize=(7, 3.2))
    for i, (chosen, title) in enumerate(
        ((picked, "the pieces that the scheme selects"), (meeting, "the pieces that collide"))
    ):
        ax = scene(query, 2.0, title, (1, 2, i + 1), (65, -80), (0.9, 1.4, 0))
        for side, (body, pose, pale, dark) in enumerate(
            ((query.b, query.pose_b, B, CHOSEN_B), (query.a, query.pose_a, A, CHOSEN_A))
        ):
            for j, piece in enumerate(body.pieces):
                own = chosen[1 - side] == j
                whole(
                    ax, piece, pose, dark if own else pale, 0.7 if own else 0.3, 2 * side + own + 1
                )
    save(path)


def save(path: Path) -> None:
    plt.tight_layout()
    plt.savefig(path, dpi=110)
    plt.close()


FIGURES = {"selections": selections, "virtual_edges": virtual_edges, "pieces": pieces}


def main(folder: str) -> None:
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        draw(Path(folder) / f"{name}.png")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("Name the output folder: python -m experiments.publish.article FOLDER")
    main(sys.argv[1])
