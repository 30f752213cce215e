# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Methods that each break one property: the conformance suite must find every one."""

import os

from baselines.contract import Method, Unsupported, Verdict


class Aligned(Method):
    """The offset of two axis-aligned cubes, whatever way they are turned."""

    name = "faulty-aligned"
    engine, imports = "numpy", "numpy"
    configuration = "article"
    questions = frozenset({"overlap"})
    bodies = frozenset({"convex"})
    solid = True
    guarantee = "none"

    def prepare(self, query):
        self.refuse(query)
        offset = abs(query.pose_a.position - query.pose_b.position).max()
        return lambda: Verdict(bool(offset < 2))


class Never(Aligned):
    name = "faulty-never"

    def prepare(self, query):
        self.refuse(query)
        return lambda: Verdict(False)


class Fickle(Aligned):
    name = "faulty-fickle"
    asked = 0

    def prepare(self, query):
        self.refuse(query)

        def ask():
            self.asked += 1
            return Verdict(self.asked % 2 == 0)

        return ask


class Careless(Aligned):
    name = "faulty-careless"

    def prepare(self, query):
        return lambda: Verdict(False)


class Late(Aligned):
    name = "faulty-late"
    questions = frozenset({"translation"})
    gives_time = True
    time_error = 0.01

    def prepare(self, query):
        self.refuse(query)
        start, reach = query.pose_a.position, query.motion.displacement
        meets = reach[0] > 0 and abs(start[1]) < 2 and start[0] + reach[0] > -2
        return lambda: Verdict(bool(meets), 0.9) if meets else Verdict(False)


class Aborting(Aligned):
    name = "faulty-aborting"

    def prepare(self, query):
        self.refuse(query)
        return os.abort


class Mute(Aligned):
    name = "faulty-mute"

    def prepare(self, query):
        if query.question not in self.questions or query.a.kind not in self.bodies:
            raise Unsupported("")
        return super().prepare(query)


class OneEyed(Late):
    """Says that it knows two movers, and reads A's motion alone."""

    name = "faulty-one-eyed"
    movers, about = 2, True
    time_error = float("nan")

    def prepare(self, query):
        self.refuse(query)
        start, reach = query.pose_a.position - query.pose_b.position, query.motion.displacement
        met = start[0] < -2 and abs(start[1]) < 2 and start[0] + reach[0] > -2
        return lambda: Verdict(True, (-2 - start[0]) / reach[0]) if met else Verdict(False)


class Unaware(OneEyed):
    """The same without a word about movers, as one writes who never heard of motion_b."""

    name = "faulty-unaware"
    movers, about = Aligned.movers, Aligned.about


class Spinning(Aligned):
    """Sees no turn."""

    name = "faulty-spinning"
    questions = frozenset({"motion"})
    movers, about = 2, True

    def prepare(self, query):
        self.refuse(query)
        return lambda: Verdict(False)


METHODS = [OneEyed, Unaware, Spinning, Aligned, Never, Fickle, Careless, Late, Aborting, Mute]
