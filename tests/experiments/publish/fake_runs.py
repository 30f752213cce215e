# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Runs in memory: methods and families of the catalogue, answered as a test tells them."""

import numpy as np
import pandas as pd

from baselines import registry
from experiments.analysis import outcome
from experiments.cases import families
from experiments.publish.findings.claims import CLAIMS, finding
from experiments.publish.findings.runs import (
    Missing,
    Runs,
)
from experiments.run import config

N = 80  # cases of a kind: enough for a verdict


class Fake(Runs):
    """Runs in memory with methods and families of the catalogue; N cases of each family, answered
    as told.

    wrong(method, scenario, i): the answer is; late(method, i): its time is off by so much;
    slow(method, level): net time; noise(method, level): of its floor; unknown: of the hits at an
    end, how many name no faces that meet.
    """

    def __init__(
        self,
        wrong=lambda method, scenario, i: False,
        label="hit",
        late=lambda method, i: 0.0,
        slow=lambda method, level: 1.0,
        rows=None,
        noise=lambda method, level: 0.0,
        unknown=0,
        ratios=None,
    ):
        super().__init__("nowhere")
        self.wrong, self.label, self.late, self.slow, self.rows = wrong, label, late, slow, rows
        self.noise, self.unknown, self.ratios = noise, unknown, ratios

    board = "standard"
    finished = ()

    def answers(self, run):
        if run not in self._read:
            self._read[run] = self._answers(config.load(run))
        return self._read[run]

    def _answers(self, chosen):
        families = dict.fromkeys(
            c.name for c in chosen.scenarios if c.name not in ("large_mesh", "real_motion")
        )
        cases = pd.DataFrame(
            [
                {
                    "case": f"{name}/{i}",
                    "scenario": name,
                    "level": float(i % 3),
                    "question": ASKED[name],
                    "label": self.label,
                    "start": "clear",
                    "end": "clear",
                    "gap": -0.5 if self.label == "hit" else 0.5,
                    "t_lo": 0.5,
                    "t_hi": 0.5,
                    "size": 1.0,
                    "faces": 12,
                    "certificate": "",
                    "tags": '{"place": "inside", "feature": "edge-edge"}',
                }
                for name in families
                for i in range(N)
            ]
        )
        methods = [
            m.label
            for spec in chosen.methods
            if spec.startswith(("ofg", "brute", "fcl-convex-substeps"))
            for m in registry.make(spec)
        ]
        answers = pd.DataFrame(
            [
                (
                    m,
                    c.case,
                    "ok",
                    (self.label == "hit") != self.wrong(m, c.scenario, int(c.case.split("/")[1])),
                    0.5 + self.late(m, int(c.case.split("/")[1])),
                    "",
                )
                for m in methods
                for c in cases.itertuples()
            ],
            columns=["method", "case", "status", "hit", "time", "detail"],
        )
        return outcome.judge(answers, cases)

    def bodies(self, run):
        return dict.fromkeys(self.answers(run).case, "convex and mesh")

    def known(self, run):
        meet = [i >= self.unknown for i in range(N)]
        found = ["end" if i % 2 else "start" for i in range(N)]
        at_end = pd.DataFrame({"found": found, "meet": meet, "late": 0.5})
        return pd.concat([at_end, at_end.assign(found="nothing", meet=False)])

    def times(self, run):
        levels, methods = (
            (20.0, 320.0, 5120.0),
            (
                "ofg k=8",
                "ofg k=64",
                "brute-force",
                "ofg k=8 repairs=all",
                "ofg k=8 toi=bisection",
            ),
        )
        return pd.DataFrame(
            [
                {
                    "case": f"{level}/{i}",
                    "method": m,
                    "level": level,
                    "question": "overlap",
                    "situation": "near",
                    "net": self.slow(m, level) * 1e3,
                    "ns": self.slow(m, level) * 1e3,
                    "noise": self.noise(m, level),
                }
                for m in methods
                for level in levels
                for i in range(5)
            ]
        )

    def file(self, name):
        if name == "native/ratios.parquet" and self.ratios is not None:
            return self.ratios
        if self.rows is None or ("class" in self.rows) != name.startswith("native"):
            raise Missing(f"run {name.split('/')[0]} is missing")
        return self.rows


ASKED = {name: s.question for name, s in families.scenarios().items()}


def of(title: str, runs):
    return finding(next(c for c in CLAIMS if c.title.startswith(title)), runs)


def said(title: str, runs) -> str:
    return of(title, runs).verdict


TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
