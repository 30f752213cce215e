# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""The claims in the order of the page: those of the article, then those that it does not make."""

from . import basic, concave, moving, project, verified
from .claim import Claim, Finding, finding

__all__ = ["CLAIMS", "Claim", "Finding", "finding"]

CLAIMS: tuple[Claim, ...] = (
    basic.selection,
    basic.pairs,
    basic.after_selection,
    basic.higher_k,
    basic.typical_k,
    basic.small_faces,
    basic.low_poly,
    basic.deep,
    basic.all_pairs,
    project.engines_speed,
    project.batch_speed,
    verified.verified_speed,
    moving.thin_walls,
    moving.flights,
    moving.start_spheres,
    moving.velocity,
    moving.halving,
    moving.untimed,
    moving.chords,
    concave.one_pair_of_pieces,
    concave.undivided,
    basic.contained,
    basic.false_alarms,
    project.robust,
    project.repaired,
)
