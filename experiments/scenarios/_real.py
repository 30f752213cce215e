"""Which real meshes a family draws, and in which form."""

from experiments.shapes import CONVEX_MESHES, real_concave, real_convex, real_pieces
from ofg import Body

CONVEX = tuple(CONVEX_MESHES)
SURFACES = ("cone", "lower_leg", "shin", "knuckle", "shape_sorter", "guide", "bunny")
# The first four are what CoACD cuts within about 3 s in all; the others come in pieces.
DECOMPOSED = ("cone", "lower_leg", "shin", "knuckle")
PIECES = ("tray", "xarm_link4", "duck_pieces", "upper_leg", "teddy")


def any_pair(rng) -> tuple[Body, Body, str]:
    """Two bodies and the kind of pair: both convex, a closed surface with a convex body or another, or unions of pieces."""
    kind = ("convex", "surface", "union")[rng.integers(3)]
    if kind == "convex":
        return _convex(rng), _convex(rng), kind
    draw = _surface if kind == "surface" else _union
    return (_convex(rng) if rng.random() < 0.5 else draw(rng)), draw(rng), kind


def _convex(rng) -> Body:
    return real_convex(CONVEX[rng.integers(len(CONVEX))])


def _surface(rng) -> Body:
    return real_concave(SURFACES[rng.integers(len(SURFACES))])


def _union(rng) -> Body:
    i = rng.integers(len(DECOMPOSED) + len(PIECES))
    return real_concave(DECOMPOSED[i], "union") if i < len(DECOMPOSED) else real_pieces(PIECES[i - len(DECOMPOSED)])
