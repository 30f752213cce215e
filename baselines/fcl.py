# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""FCL 0.7 through python-fcl: convex and mesh overlap, signed distance, and each usable mode of its
continuous request.

Convex methods test a union in a plain loop over all pairs of its pieces; mesh methods use the
triangle soup of all pieces. Pitfalls avoided here:
- python-fcl's CollisionResult accumulates, so every call gets a new one; a Transform takes 5 us to
  make, so poses are prebuilt.
- `CCDM_LINEAR` never initialises its reference point, so its answers depend on what the process
  freed before: see `_Linear`.
- Conservative advancement of a Convex against a BVH segfaults; here both bodies always have the
  same form. Modes without usable answers are not offered: RAY_SHOOTING (returns -1), POLYNOMIAL
  (changes the model, time 0), SPLINE, and SCREW (another path than ours; pure translations 0.27 of
  the step early, head-on at 0.3).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import numpy as np

from ofg import Body, Pose, Query

from .contract import Method, MissingEngine, Tolerance, Unsupported, Verdict
from .fcl_heap import HEAP, fill_motions, repeatable
from .sampling import Discrete, Substeps
from .units import Normalised

#: length: collision_tolerance and distance_tolerance of both of FCL's GJK solvers, by their headers
GJK = 1e-6


def _fcl():
    try:
        import fcl
    except ImportError as error:
        raise MissingEngine(
            "python-fcl is not installed; install it with: pip install python-fcl"
        ) from error
    return fcl


class _Convex:
    """Bodies as convex polyhedra (GJK/EPA); a union is a loop over all pairs of pieces."""

    engine, imports = "python-fcl", "fcl"
    bodies = frozenset({"convex", "union"})
    solid = True

    def shapes(self, body: Body) -> list:
        fcl = _fcl()
        return [
            fcl.Convex(p.vertices, len(p.faces), np.insert(p.faces, 0, 3, axis=1).ravel().tolist())
            for p in body.pieces
        ]


class _Mesh:
    """Bodies as bounding-volume trees over their triangles (OBBRSS): surfaces, so containment is
    not detected.
    """

    engine, imports = "python-fcl", "fcl"
    bodies = frozenset({"convex", "union", "mesh"})
    solid = False

    def shapes(self, body: Body) -> list:
        model = _fcl().BVHModel()
        model.beginModel(len(body.faces), len(body.vertices))
        model.addSubModel(body.vertices, body.faces)
        model.endModel()
        return [model]


class _Overlap(Discrete):
    """fcl.collide on every pair of shapes up to the first hit. Subclasses mix in `shapes`."""

    solver = "GST_LIBCCD"
    places_b = True

    def build(self, query: Query):
        fcl = _fcl()
        objects_a = [fcl.CollisionObject(s, fcl.Transform()) for s in self.shapes(query.a)]
        at_b = _transform(query.pose_b)
        objects_b = [fcl.CollisionObject(s, at_b) for s in self.shapes(query.b)]
        pairs = list(product(objects_a, objects_b))
        movers = objects_a if query.motion_b.rests else objects_a + objects_b
        ask = self.ask_pair(fcl)

        def place(*poses: Pose) -> list:  # a transform for each mover
            transforms = [_transform(pose) for pose in poses]
            return [at for at, side in zip(transforms, (objects_a, objects_b)) for _ in side]

        def test(places) -> bool:
            for mover, at in zip(movers, places):
                mover.setTransform(at)
            return any(ask(a, b) for a, b in pairs)

        return place, test

    def ask_pair(self, fcl) -> Callable:
        request = fcl.CollisionRequest(gjk_solver_type=getattr(fcl.GJKSolverType, self.solver))
        return lambda a, b: fcl.collide(a, b, request, fcl.CollisionResult()) > 0


class FclConvex(_Convex, _Overlap):
    name = "fcl-convex"
    configuration = "default"
    tolerance = Tolerance(GJK)
    guarantee = "GJK (libccd) in doubles, to 1e-6 of its own units by the documentation"


class FclConvexExact(Normalised, FclConvex):
    # In small units, faces wedged into each other at a tilt of 1e-7 to 1e-9 are missed: 39 of 62
    # hits with radius 32, 13 with 1024, none in the unit chosen since (near_parallel).
    name = "fcl-convex-exact"
    configuration = "best effort"
    guarantee = "GJK (libccd) in doubles, in the unit of units.csv, at the origin"


class FclConvexExactSubsteps(Substeps, FclConvexExact):
    name = "fcl-convex-exact-substeps"
    guarantee = "fcl-convex-exact at n sampled poses; misses contacts between samples"


class FclConvexIndep(FclConvex):
    # False hits on cubes at gaps of 1e-6 and less; libccd, the default, is more accurate.
    name = "fcl-convex-indep"
    configuration = "alternative"
    solver = "GST_INDEP"
    guarantee = "GJK (FCL's own solver, tolerance 1e-6)"


class FclMesh(_Mesh, _Overlap):
    name = "fcl-mesh"
    configuration = "default"
    guarantee = "exact triangle pairs in doubles; surfaces only"


class FclDistance(FclConvex):
    """Overlap by the sign of the signed distance.

    Aborts the process (uncaught std::logic_error in EPA) near contact: cubes face to face, rotated
    together, 6, 3, 8, 4, 2 of 600 at -1e-8, -1e-9, -1e-10, -1e-11, -1e-12. It is a separate method
    so that its rows show this.
    """

    name = "fcl-distance"
    configuration = "alternative"
    guarantee = "signed distance by GJK/EPA (libccd); may abort the process near contact"

    def ask_pair(self, fcl) -> Callable:
        request = fcl.DistanceRequest(enable_signed_distance=True)
        return lambda a, b: fcl.distance(a, b, request, fcl.DistanceResult()) < 0


class FclConvexSubsteps(Substeps, FclConvex):
    name = "fcl-convex-substeps"
    guarantee = "fcl-convex at n sampled poses; misses contacts between samples"


class FclMeshSubsteps(Substeps, FclMesh):
    name = "fcl-mesh-substeps"
    guarantee = "fcl-mesh at n sampled poses; misses contacts between samples"


class _Continuous(Method):
    """fcl.continuousCollide from pose to pose. Subclasses mix in `shapes` and choose the modes.

    FCL takes two poses of each body and the shortest rotation between them, about the body's
    origin, so a motion of more than 3 rad is divided into legs.
    """

    gives_time = True
    movers = 2
    solver = "GST_LIBCCD"
    advancement = "CCDC_CONSERVATIVE_ADVANCEMENT"
    path = {"translation": "CCDM_TRANS", "motion": "CCDM_LINEAR"}

    def limits(self) -> dict:
        """The accuracy settings of the request: num_max_iterations, toc_err."""
        return {}

    def prepare(self, query: Query) -> Callable[[], Verdict]:
        self.refuse(query)
        path = self.path[query.question]
        linear = path == "CCDM_LINEAR"
        if linear and not repeatable(_fcl()):
            raise Unsupported(
                "CCDM_LINEAR reads uninitialised memory, and this platform's malloc does not let "
                "us set it beforehand"
            )
        fcl = _fcl()
        request = fcl.ContinuousCollisionRequest(
            ccd_motion_type=getattr(fcl.CCDMotionType, path),
            gjk_solver_type=getattr(fcl.GJKSolverType, self.solver),
            ccd_solver_type=getattr(fcl.CCDSolverType, self.advancement),
            **self.limits(),
        )
        legs = self.legs(query, 1 if path == "CCDM_TRANS" else _legs(query))
        n, fill = len(legs), HEAP[self.parameters["heap"]] if linear else 0

        def ask() -> Verdict:
            for start, stop_a, stop_b, pairs in legs:
                first = math.inf
                for a, b in pairs:
                    result = fcl.ContinuousCollisionResult()
                    if linear:
                        fill_motions(fill)
                    fcl.continuousCollide(a, stop_a, b, stop_b, request, result)
                    if result.is_collide:
                        first = min(first, result.time_of_contact)
                if first < math.inf:
                    return Verdict(True, start + first / n)
            return Verdict(False)

        return ask

    def legs(self, query: Query, n: int) -> list[tuple]:
        """(its start, both end poses, pairs of objects at their start poses) of each of n equal
        legs.
        """
        fcl, shapes = _fcl(), (self.shapes(query.a), self.shapes(query.b))
        sides = ((query.motion, query.pose_a), (query.motion_b, query.pose_b))
        stops = [[_transform(m.pose_at(p, i / n)) for m, p in sides] for i in range(n + 1)]
        legs = []
        for i, (at, end) in enumerate(zip(stops, stops[1:])):
            objects = [[fcl.CollisionObject(s, t) for s in side] for side, t in zip(shapes, at)]
            legs.append((i / n, *end, list(product(*objects))))
        return legs


def _legs(query: Query) -> int:
    return max(1, math.ceil(max(abs(query.motion.angle), abs(query.motion_b.angle)) / 3))


class _DefaultRequest(_Continuous):
    """A default ContinuousCollisionRequest(): conservative advancement, CCDM_TRANS, 10 iterations,
    toc_err 1e-4.

    CCDM_TRANS moves a body along a line and ignores its rotation, so `motion` is not declared: the
    request for it is CCDM_LINEAR (fcl-advancement-*, fcl-naive-*).
    """

    configuration = "default"
    questions = frozenset({"translation"})


class FclCcdMesh(_Mesh, _DefaultRequest):
    # Cubes of size 2 passing through each other, head-on and rotated: 37 of 40 missed. Known
    # upstream (fcl 555, python-fcl 38).
    name = "fcl-ccd-mesh"
    tolerance = Tolerance(step=1e-4)
    guarantee = (
        "conservative advancement, time within toc_err = 1e-4; translations only (CCDM_TRANS)"
    )


class FclCcdConvex(_Convex, _DefaultRequest):
    # Boxes straight through a plate: 17 of 250 missed with libccd, none with GST_INDEP, as below.
    name = "fcl-ccd-convex"
    tolerance = Tolerance(GJK, step=1e-4)
    guarantee = (
        "conservative advancement, time within toc_err = 1e-4; translations only (CCDM_TRANS)"
    )


class _Linear(_Continuous):
    """CCDM_LINEAR for motions; FCL reads its reference point before anything has written it.

    heap: the bytes found there. "zero" is the body's origin, which FCL documents; "filled" is
    HEAP's other byte. In a process without this parameter, they are whatever was freed before. Both
    give the answers of a process whose whole heap contains that byte, with equal verdicts and
    times. Of the 2,789 sweeps of the standard run with up to 400 faces, fcl-advancement-convex
    path=trans misses 87 with "zero" and 253 with "filled", and reports 48 and 307 clear ones as
    hits.
    """

    configuration = "best effort"
    questions = frozenset({"translation", "motion"})


class _Advancement(_Linear):
    """Conservative advancement at its best: GST_INDEP, CCDM_LINEAR for all, 1000 iterations.

    For hulls, misses of 253 certified translations that hit, then false hits of 182 that do not
    (seven families): GST_INDEP 0, 3; with CCDM_TRANS, which supports translations only, 10, 3.
    GST_LIBCCD 18, 4; with CCDM_TRANS 27, 5. toc_err changes none of these. On the cases of the
    standard run the two paths miss 5 and 86 of 856, with 18 and 16 false hits of 621. Boxes that
    fall obliquely through a plate, in the first order: 0, 65, 15, 45 of 250 missed. CCDM_LINEAR
    takes half as long again; path=trans uses CCDM_TRANS for translations. Meshes miss 224 of 262 on
    either.
    Its times depend on the last bit of a pose: changing a quaternion by 1e-16 moved one by 6e-7 of
    the step.
    """

    parameters = {"toc_err": 1e-4, "path": "linear", "heap": "zero"}
    allowed = {"toc_err": (1e-15, 1.0), "path": ("linear", "trans"), "heap": tuple(HEAP)}
    solver = "GST_INDEP"
    guarantee = "conservative advancement, time within toc_err"

    @property
    def tolerance(self) -> Tolerance:
        return Tolerance(GJK, step=self.parameters["toc_err"])

    @property
    def path(self) -> dict:
        return {"translation": f"CCDM_{self.parameters['path'].upper()}", "motion": "CCDM_LINEAR"}

    def limits(self) -> dict:
        return {"num_max_iterations": 1000, "toc_err": self.parameters["toc_err"]}


class FclAdvancementConvex(Normalised, _Convex, _Advancement):
    name = "fcl-advancement-convex"


class FclAdvancementMesh(Normalised, _Mesh, _Advancement):
    name = "fcl-advancement-mesh"


class _Naive(_Linear):
    """The NAIVE mode: `iterations` samples at i / (iterations - 1). It is late by up to one
    spacing and misses contacts between samples.
    """

    parameters = {"iterations": 10, "heap": "zero"}
    allowed = {"iterations": (2, 2**31 - 1), "heap": tuple(HEAP)}  # at least the start and the end
    cheapest = {"iterations": 2}
    advancement = "CCDC_NAIVE"
    guarantee = (
        "discrete test at evenly spaced samples of FCL's own interpolation; misses contacts "
        "between samples"
    )

    def limits(self) -> dict:
        # FCL samples min(num_max_iterations, ceil(1 / toc_err)) poses.
        return {
            "num_max_iterations": self.parameters["iterations"],
            "toc_err": 0.5 / self.parameters["iterations"],
        }

    @property
    def time_error(self) -> float:
        return 1 / (self.parameters["iterations"] - 1)


class FclNaiveConvex(Normalised, _Convex, _Naive):
    name = "fcl-naive-convex"


class FclNaiveMesh(Normalised, _Mesh, _Naive):
    name = "fcl-naive-mesh"


def _transform(pose: Pose):
    return _fcl().Transform(pose.rotation, pose.position)


METHODS = [
    FclConvex,
    FclConvexExact,
    FclConvexExactSubsteps,
    FclConvexIndep,
    FclMesh,
    FclDistance,
    FclConvexSubsteps,
    FclMeshSubsteps,
    FclCcdMesh,
    FclCcdConvex,
    FclAdvancementConvex,
    FclAdvancementMesh,
    FclNaiveConvex,
    FclNaiveMesh,
]
