"""results/README.md: what the runs say of each claim of the article and of each engine, every figure and verdict computed from their rows.

A claim is a function of the runs that returns a verdict, the number that carries it, and what else was found. The words around it (the
claim, where the article makes it, the rule of the verdict, where the rows are, the limits) are given to the decorator. A run or a row
that is not there makes the claim "not measured".
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Callable

import numpy as np
import pandas as pd

from baselines import registry

from . import claims as sizes
from . import config as configuration
from . import metrics, tables
from .store import Store, StoreError

MISSES = 0.05  # a rate of misses is small if its whole interval lies under this, large if above
LATE = 1e-3  # of the step: what an estimate of the time of impact may be off
HOLDS, PART, FAILS, OPEN, UNMEASURED = "holds", "holds in part", "fails", "open", "not measured"


class Missing(Exception):
    """What cannot be said, because a run or rows of it are not there."""


class Runs:
    """The runs in a folder of results, read when they are first asked for. Every method raises Missing where there is none."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self._read: dict = {}

    def answers(self, run: str) -> pd.DataFrame:
        """metrics.outcomes of a run."""
        return self._once(("answers", run), lambda: metrics.outcomes(Store(self.folder / run)))

    def times(self, run: str) -> pd.DataFrame:
        """metrics.case_costs of a run, with the scenario and level of each case."""
        cases = lambda: self.answers(run)[["case", "scenario", "level"]].drop_duplicates()  # noqa: E731
        return self._once(("times", run), lambda: metrics.case_costs(Store(self.folder / run)).merge(cases(), on="case"))

    def file(self, name: str) -> pd.DataFrame:
        """A frame of the folder: claims/claims.parquet, native/native.csv, stepping/stepping.parquet."""
        read = pd.read_csv if name.endswith(".csv") else pd.read_parquet
        return self._once(("file", name), lambda: read(self.folder / name))

    @cached_property
    def board(self) -> str:
        """The run with every family: standard, or quick where there is no standard."""
        return next((run for run in ("standard", "quick") if (self.folder / run / "observations.parquet").exists()), "standard")

    @cached_property
    def finished(self) -> list[str]:
        return sorted(p.parent.name for p in self.folder.glob("*/observations.parquet"))

    def _once(self, key, read):
        if key not in self._read:
            try:
                self._read[key] = read()
            except (StoreError, FileNotFoundError):
                run = key[1].split("/")[0]
                raise Missing(f"run {run} is missing" if not (self.folder / run).exists() else f"run {run} is not finished, or has no times") from None
        return self._read[key]


@dataclass(frozen=True)
class Rate:
    count: int
    total: int
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.count}/{self.total} ({100 * self.low:.1f}-{100 * self.high:.1f} %)"

    @property
    def small(self) -> bool:
        return self.high <= MISSES

    @property
    def large(self) -> bool:
        return self.low > MISSES


def rows(frame: pd.DataFrame, **wanted) -> pd.DataFrame:
    """The rows whose columns have the wanted value, or one of several. Missing if there are none."""
    for column, value in wanted.items():
        frame = frame[frame[column].isin(value if isinstance(value, (list, tuple)) else [value])]
    if frame.empty:
        raise Missing("no rows with " + ", ".join(f"{c} {v}" for c, v in wanted.items()))
    return frame


def rate(frame: pd.DataFrame, kind: str = "misses", **wanted) -> Rate:
    """Misses, false alarms or tunnelled of the certified cases answered, by metrics.rates. Missing if there is no such case."""
    count, total, interval, _ = tables.COUNTS[kind]
    part = rows(frame, **wanted)
    found = metrics.rates(part.assign(all=0), ["all"]).iloc[0]
    if not found[total]:
        raise Missing(f"no certified {total} among {len(part)} rows")
    return Rate(int(found[count]), int(found[total]), found[f"{interval}_low"], found[f"{interval}_high"])


def size_rates(runs: Runs, depth: str, k: int) -> dict[int, Rate]:
    """Misses of the claims run at a depth by number of faces; only sizes above k."""
    found = rows(sizes.misses(runs.file("claims/claims.parquet")), depth=depth, k=k, repairs=False)
    found = rows(found[found.faces > k], depth=depth)
    return {r.faces: Rate(r.misses, r.hits, r.miss_low, r.miss_high) for r in found.itertuples()}


def are_small(rates) -> str:
    """The verdict on rates that are claimed to be small."""
    rates = list(rates)
    if all(r.small for r in rates):
        return HOLDS
    if all(r.large for r in rates):
        return FAILS
    return PART if any(r.large for r in rates) else OPEN


def ratio(times: pd.DataFrame, method: str, reference: str, by: str) -> pd.DataFrame:
    """metrics.ratios of one method, indexed by `by`: ratio, low, high, pairs."""
    found = metrics.ratios(rows(times, method=[method, reference]), reference, [by])
    return rows(found, method=method).set_index(by).sort_index()


def or_reason(find: Callable) -> str:
    """What find() says, or why it cannot be said: for what stands beside a verdict and does not decide it."""
    try:
        return str(find())
    except Missing as reason:
        return f"not measured ({reason})"


def ratios_listed(times: Callable[[], pd.DataFrame], method: str, reference: str, by: str) -> str:
    return or_reason(lambda: listed((key, times_more(r)) for key, r in ratio(times(), method, reference, by).iterrows()))


def listed(values, form: Callable = str) -> str:
    return "; ".join(f"{key:g}: {form(value)}" if isinstance(key, (int, float, np.number)) else f"{key}: {form(value)}" for key, value in dict(values).items())


def spread(rates: dict) -> str:
    """The lowest and the highest of several rates, with what they are of."""
    named = {f"{key} faces" if isinstance(key, (int, np.integer)) else key: r for key, r in rates.items()}
    low, *_, high = sorted(named, key=lambda key: (named[key].count / named[key].total, named[key].total)) * (2 if len(named) == 1 else 1)
    return f"{low} {named[low]}" if low == high else f"{low} {named[low]} to {high} {named[high]}"


def times_more(r) -> str:
    return f"{r.ratio:.3g} [{r.low:.3g}, {r.high:.3g}], n={r.pairs}"


# --- the claims, in the article's order


@dataclass(frozen=True)
class Claim:
    title: str
    section: str
    rule: str
    where: tuple[str, ...]
    limits: str
    find: Callable[[Runs], tuple[str, str, str]]


@dataclass(frozen=True)
class Finding:
    claim: Claim
    verdict: str
    number: str
    text: str


CLAIMS: list[Claim] = []


def claim(title: str, section: str, rule: str, where: str, limits: str):
    """Register a function Runs -> (verdict, number, text). where: tables, with {board} for the run that has every family."""

    def add(find):
        CLAIMS.append(Claim(title, section, rule, tuple(where.split()), limits, find))
        return find

    return add


def finding(asked: Claim, runs: Runs) -> Finding:
    try:
        return Finding(asked, *asked.find(runs))
    except Missing as reason:
        return Finding(asked, UNMEASURED, f"not measured ({reason})", "")


BASIC, TIME, TURN = "The OFG algorithm", "Solving the discrete time problem", "Solving for rotating objects"
CONCAVE, PROBLEMS = "Solving the concavity problem", "Problems with the basic OFG algorithm"
HULLS = "Random hulls of one size against each other."
FEW, MANY = sizes.FACES[1], sizes.FACES[3]  # "few faces" and "many", of those measured


def depth_range(name: str) -> str:
    low, high = sizes.DEPTHS[name]
    return f"{low:g} to {high:g} radii deep along a contact normal"



@claim("Selecting faces costs O(n + m)", f"{BASIC}, steps 2 and 4", "at most n + m distances in every query", "claims/tables/operations.md faces/tables/faces-gross.md",
       f"{HULLS} Distances are counted as the article has them; blocks of faces are passed over by one bound, which is what `computed` counts.")
def selection(runs: Runs):
    found = rows(sizes.operations(runs.file("claims/claims.parquet")), question="overlap")
    most, last = found.distances_max.max(), rows(found, k=8).iloc[-1]

    def growth():
        first, *_, end = metrics.medians(rows(runs.times("faces"), method="ofg k=8"), "ns", ["level"]).sort_values("level").itertuples()
        return f"{end.level / first.level:.0f} times the faces take {end.median / first.median:.1f} times as long (n={first.cases} and {end.cases})"

    text = f"With k = 8 at {last.faces} faces {100 * last.evaluated_mean:.1f} % of them are really computed, on average. Gross, from Python: {or_reason(growth)}."
    return (HOLDS if most <= 1 else FAILS), f"at most {most:.2f} (n + m); n={found.queries.sum()} queries", text


@claim("At most k^2 pairs of faces are tested", f"{BASIC}, step 8", "at most k^2 pairs in every query", "claims/tables/operations.md", f"{HULLS} Overlapping pairs, {depth_range('shallow')}, and {depth_range('deep')}.")
def pairs(runs: Runs):
    found = rows(sizes.operations(runs.file("claims/claims.parquet")), question="overlap")
    eight = rows(found, k=8)
    mean = np.average(eight.pairs_mean, weights=eight.queries)
    full = np.average(eight.full_tests_mean, weights=eight.queries)
    return ((HOLDS if found.pairs_max.max() <= 1 else FAILS), f"at most {found.pairs_max.max():.2f} k^2; n={found.queries.sum()} queries",
            f"With k = 8 the mean over all sizes is {mean:.2g} k^2 pairs, since the first pair that meets ends it, and {full:.2g} k^2 that no cheap rejection settles.")


@claim("k^2 + 3k operations replace n m", f"{BASIC}, step 8; {TIME}, steps 3 to 6", "at most k^2 + 3k face pairs and edge-face tests in every query, for poses and for sweeps",
       "claims/tables/operations.md", f"{HULLS} A pair of faces and a virtual edge against a face each count as one. A sweep has up to 3k virtual edges against k faces, and two times k^2 pairs.")
def after_selection(runs: Runs):
    found = sizes.operations(runs.file("claims/claims.parquet"))
    most = {q: rows(found, question=q).after_selection_max.max() for q in ("overlap", "translation", "motion")}
    kept = [value <= 1 for value in most.values()]
    number = f"at most, in k^2 + 3k: {listed(most, '{:.3g}'.format)}; n={found.queries.sum()}"
    large = rows(found, question="overlap", k=8, faces=1280).iloc[0]
    share = large.after_selection_mean * (64 + 24) / 1280**2
    return (HOLDS if all(kept) else PART if any(kept) else FAILS), number, f"At 1280 faces and k = 8 an overlap query takes {share:.1e} of n m, on average."


@claim("A higher k is more accurate", BASIC, "misses never rise from one k to the next, in any family (in part: not in all families together)", "k/tables/k-misses.md",
       "k = 1 to 512; with k above the number of faces all are selected.")
def higher_k(runs: Runs):
    found = runs.answers("k")
    ks = sorted({int(m.split("=")[1]) for m in found.method if m.startswith("ofg k=") and m.count(" ") == 1})
    if len(ks) < 2:
        raise Missing("fewer than two k in run k")
    methods = [f"ofg k={k}" for k in ks]
    pooled = {k: rate(found, method=m) for k, m in zip(ks, methods)}
    missed = rows(found, method=methods).assign(missed=lambda t: t.outcome == "miss").pivot(index="case", columns="method", values="missed")[methods]
    lost = int((missed.astype(int).diff(axis=1) > 0).any(axis=1).sum())
    by_family = rows(found, method=methods, label="hit").assign(missed=lambda t: t.outcome == "miss").pivot_table(index="scenario", columns="method", values="missed", aggfunc="sum")[methods]
    rising = list(by_family.index[(by_family.diff(axis=1) > 0).any(axis=1)])
    counts = [r.count for r in pooled.values()]
    falls = all(a >= b for a, b in zip(counts, counts[1:])) and counts[0] > counts[-1]
    text = f"Misses by k: {listed(pooled)}. {lost} of {len(missed)} cases are found by some k and missed by the next larger one"
    text += f"; misses rise somewhere in {', '.join(rising)}." if rising else "; misses rise in no family."
    return (FAILS if not falls else PART if rising else HOLDS), f"missed: k={ks[0]} {pooled[ks[0]]}, k={ks[-1]} {pooled[ks[-1]]}", text


@claim("k of 4 to 8 is enough", f"{BASIC}, typical values", f"misses of shallow overlaps with k = 8 under {MISSES:.0%} at every size", "claims/tables/misses.md k/tables/k-misses.md",
       f"{HULLS} {depth_range('shallow')}.")
def typical_k(runs: Runs):
    eight, four = (size_rates(runs, "shallow", k) for k in (8, 4))
    return are_small(eight.values()), f"missed with k=8: {spread(eight)}", f"By faces, k = 8: {listed(eight)}. k = 4: {listed(four)}."


@claim("Small faces need a higher k", BASIC, "k = 8 misses more of the largest bodies than of the smallest, intervals apart", "claims/tables/misses.md", f"{HULLS} Shallow overlaps. k of {', '.join(map(str, sizes.KS))}.")
def small_faces(runs: Runs):
    eight = size_rates(runs, "shallow", 8)
    small, large = eight[min(eight)], eight[max(eight)]
    found = rows(sizes.misses(runs.file("claims/claims.parquet")), depth="shallow", repairs=False)
    enough = {}
    for faces, part in found.groupby("faces"):
        ok = part[(part.miss_high <= MISSES) & part.k.isin(sizes.KS)].k
        enough[faces] = f"k={ok.min()}" if len(ok) else f"none up to {part.k[part.k.isin(sizes.KS)].max()}"
    verdict = HOLDS if large.low > small.high else FAILS if large.high < small.low else OPEN
    return verdict, f"missed with k=8: {min(eight)} faces {small}, {max(eight)} faces {large}", f"The smallest k with misses under {MISSES:.0%}, by faces: {listed(enough)}."


@claim("Best for convex bodies of few faces", BASIC, f"k = 8 misses less up to {FEW} faces than from {MANY} on, shallow and deep together, intervals apart", "claims/tables/misses.md concavity/tables/concavity-wrong.md",
       f"{HULLS} Concave bodies are measured below.")
def low_poly(runs: Runs):
    found = rows(runs.file("claims/claims.parquet"), question="overlap", k=8)
    few, many = (pooled(part) for part in (found[found.faces <= FEW], found[found.faces >= MANY]))
    return (HOLDS if few.high < many.low else FAILS if few.low > many.high else OPEN), f"missed with k=8: up to {FEW} faces {few}, from {MANY} {many}", ""


def pooled(part: pd.DataFrame) -> Rate:
    if part.empty:
        raise Missing("no rows of these sizes in run claims")
    missed = int((~part.hit).sum())
    return Rate(missed, len(part), *metrics.wilson(missed, len(part)))


@claim("Once bodies are in each other, the closest faces are the wrong ones", f"{PROBLEMS}, second", "k = 8 misses more deep than shallow overlaps at every size, intervals apart (in part: at some)",
       "claims/tables/misses.md gap/tables/gap-deep.md", f"{HULLS} Deep: {depth_range('deep')}. The article names this problem for moving bodies; it is there at rest too.")
def deep(runs: Runs):
    inside, shallow = (size_rates(runs, depth, 8) for depth in ("deep", "shallow"))
    worse = {faces: r.low > shallow[faces].high for faces, r in inside.items()}
    text = f"By faces, k = 8: {listed(inside)}. k = 64: {listed(size_rates(runs, 'deep', 64))}."
    same_centre = {f"k = {k}": or_reason(lambda: rate(runs.answers("gap"), method=f"ofg k={k}", scenario="deep")) for k in (8, 64)}
    text += f" Bodies with nearly the same centre (`deep`): {listed(same_centre)}."
    return (HOLDS if all(worse.values()) else PART if any(worse.values()) else FAILS), f"deep, missed with k=8: {spread(inside)}", text


@claim("Cheaper than all pairs of faces", f"{BASIC}, k^2 + 3k against n m", "all pairs take longer than k = 8 at every size, interval above 1 (in part: at some)", "faces/tables/faces-ratio.md k/tables/k-net.md",
       "Net times from Python, paired case by case; both are our own code. All pairs are tested without a tree: an engine's mesh test (fcl-mesh) is the fairer rival, below.")
def all_pairs(runs: Runs):
    found = ratio(runs.times("faces"), "brute-force", "ofg k=8", "level")
    faces = lambda: runs.times("faces")  # noqa: E731
    text = (f"All pairs over k = 8, by faces: {ratios_listed(faces, 'brute-force', 'ofg k=8', 'level')}. Over k = 64: {ratios_listed(faces, 'brute-force', 'ofg k=64', 'level')}. "
            f"Over k = 8, other cases and sweeps: {ratios_listed(lambda: runs.times('k'), 'brute-force', 'ofg k=8', 'question')}.")
    slower, ends = (found.low > 1).tolist(), found.iloc[[0, -1]]
    number = "all pairs take " + " to ".join(f"{r.ratio:.3g} [{r.low:.3g}, {r.high:.3g}] times as long ({level:g} faces, n={r.pairs})" for level, r in ends.iterrows())
    return (HOLDS if all(slower) else PART if any(slower) else FAILS), number, text


@claim("Faster than the engines (the project's question, not the article's)", "-", "k = 8 takes less than the fastest engine in every cell of size and situation (in part: in some)", "native/native.md faces/tables/faces-ratio.md",
       "Native lane: the libraries in C++, medians over pairs of random hulls, no interval. Speed alone: what k = 8 misses of such bodies stands above.")
def engines_speed(runs: Runs):
    found = runs.file("native/native.csv")
    cells, shares = {}, []
    for (situation, faces), part in found.groupby(["situation", "faces"], sort=False):
        own = rows(part, method="ofg k=8").native.iloc[0]
        rival = part[~part.method.str.startswith("ofg")].sort_values("native").iloc[0]
        cells[f"{situation} {faces}"] = f"{own / rival.native:.2f} ({rival.method})"
        shares.append(own / rival.native)
    repaired = ratios_listed(lambda: runs.times("faces"), "ofg k=8 repairs=all", "ofg k=8", "level")
    wins, third = [s < 1 for s in shares], sum(s <= 1 / 3 for s in shares)
    number = f"faster in {sum(wins)} of {len(wins)} cells; {min(shares):.2f} to {max(shares):.2f} of the fastest engine's time"
    return (HOLDS if all(wins) else PART if any(wins) else FAILS), number, f"k = 8 over the fastest engine, by situation and faces: {listed(cells)}. At most a third of its time in {third} of {len(wins)} cells. All repairs over k = 8, net, from Python, by faces: {repaired}."


@claim("Virtual edges stop what flies through a thin wall", TIME, f"tunnelled with k = 8 under {MISSES:.0%}, straight and turning", "tunnelling/tables/tunnelling-straight.md tunnelling/tables/tunnelling-turning.md",
       "Walls larger than the body, hit by its vertices. Edges and B's vertices: next.")
def thin_walls(runs: Runs):
    found = runs.answers("tunnelling")
    own = {name: rate(found, "tunnelled", method="ofg k=8", scenario=family) for name, family in (("straight", "thin_wall"), ("turning", "screw_wall"))}
    sampled = {m: rate(found, "tunnelled", method=m) for m in ("fcl-convex-substeps n=1", "fcl-convex-substeps n=16") if (found.method == m).any()}
    levels = rows(found, scenario="thin_wall").level
    return are_small(own.values()), f"tunnelled with k=8: {listed(own)}", f"{levels.min():g} to {levels.max():g} thicknesses in a step. For comparison, both walls together: {listed(sampled)}."


@claim("Virtual edges, the start and the end find every other collision in flight", TIME, f"misses of straight flights under {MISSES:.0%} with all faces in place of k (what the selection cannot be blamed for)",
       "{board}/tables/scenarios-translation.md {board}/tables/accuracy-translation.md k/tables/k-feature.md", "Families are aimed at difficulties, and pooled as the run weights them. Brute force makes the same three tests with all faces.")
def flights(runs: Runs):
    found = rows(runs.answers(runs.board), question="translation")
    every, own, mended = rate(found, method="brute-force"), *(or_reason(lambda: rate(found, method=m)) for m in ("ofg k=8", "ofg k=8 repairs=all"))
    worst = families(found, "brute-force")
    return are_small([every]), f"missed: all faces {every}, k=8 {own}", f"All repairs: {mended}. All faces miss most in {worst}: vertices of B, and edges against edges."


def families(found: pd.DataFrame, method: str, kind: str = "misses", n: int = 2) -> str:
    """The families of which a method gets the largest share wrong, of those where it gets any wrong."""
    each = {name: rate(part, kind) for name, part in rows(found, method=method, outcome=["right", "miss", "false alarm", "conservative"]).groupby("scenario") if has(part, kind)}
    worst = sorted((name for name, r in each.items() if r.count), key=lambda name: (-each[name].count / each[name].total, name))[:n]
    return listed({f"`{name}`": each[name] for name in worst}) or "no family"


def has(part: pd.DataFrame, kind: str) -> bool:
    return bool(((part.label == ("clear" if kind == "false alarms" else "hit"))).any())


@claim("Step 1, spheres at the start, suits moving bodies", f"{TIME}, step 2 read literally", f"hits that swept spheres find and spheres at the start do not are under {MISSES:.0%}, in flight and in turning flight",
       "{board}/tables/accuracy-translation.md {board}/tables/accuracy-motion.md", "Where the wall is large, its sphere holds the body from the start, and the reading makes no difference.")
def start_spheres(runs: Runs):
    found, lost = rows(runs.answers(runs.board), label="hit", status="ok"), {}
    for question in ("translation", "motion"):
        missed = rows(found, method=["ofg k=8 broad=start", "ofg k=8"], question=question).assign(missed=lambda t: t.outcome == "miss").pivot(index="case", columns="method", values="missed").dropna()
        if missed.shape[1] < 2:
            raise Missing(f"one of the readings in run {runs.board}")
        count = int((missed["ofg k=8 broad=start"].astype(bool) & ~missed["ofg k=8"].astype(bool)).sum())
        lost[question] = Rate(count, len(missed), *metrics.wilson(count, len(missed)))
    return are_small(lost.values()), f"hits lost by it: {listed(lost)}", "Swept spheres, the other reading, are the default here."


IMPACT = ("impact/tables/impact-angle.md impact/tables/impact-turn.md impact/tables/impact-latest.md impact/tables/impact-net.md", "Errors only where the method found the hit and gave a time: its misses stand in impact/tables/impact-misses.md.")


def impact(runs: Runs, estimate: str):
    """(verdict, number) of an estimate of the time of impact, and of its variants."""
    found = runs.answers("impact")
    error = metrics.times_of_impact(rows(found, method=estimate), ["method"])
    if error.empty:
        raise Missing(f"no time of {estimate} in run impact")
    e = error.iloc[0]
    middle = metrics.medians(rows(found[found.error.notna()], method=estimate).assign(off=lambda t: t.error.abs()), "off", ["method"]).iloc[0]
    number = f"error, in steps: median {e['median']:.1e} [{middle.low:.1e}, {middle.high:.1e}], 95 % within {e.p95:.1e}, latest {e.worst_late:.1e}; n={e.times}"
    return (HOLDS if e.p95 <= LATE else PART if e["median"] <= LATE else FAILS), number


@claim("Relative velocity gives the time of impact", f"{TIME}, first estimate; {TURN}", f"95 % of the times within {LATE:g} of the step (in part: half of them)", *IMPACT)
def velocity(runs: Runs):
    verdict, number = impact(runs, "ofg k=8")
    instead = {"the earliest of all virtual edges of the selection (repair `earliest`)": "ofg k=8 repairs=earliest", "all repairs": "ofg k=8 repairs=all"}
    others = {name: or_reason(lambda: impact(runs, method)[1]) for name, method in instead.items()}
    return verdict, number, f"The time is that of the first virtual edge found, not of the earliest. Instead {listed(others)}."


@claim("Halving the step gives the time of impact", f"{TIME}, second estimate; {TURN}", f"95 % of the times within {LATE:g} of the step (in part: half of them)", *IMPACT)
def bisection(runs: Runs):
    verdict, number = impact(runs, "ofg k=8 toi=bisection")
    price = ratios_listed(lambda: runs.times("impact"), "ofg k=8 toi=bisection", "ofg k=8", "situation")
    halvings = registry.methods()["ofg"].parameters["iterations"]
    return verdict, number, f"Its time over that of the velocity estimate, net: {price}. The article's log n is {halvings} halvings here."


@claim("Chords of the vertices' paths do for rotation", TURN, f"misses with k = 8 under {MISSES:.0%} in each family of turns",
       "rotation/tables/rotation-side.md rotation/tables/rotation-contact.md rotation/tables/rotation-turns.md rotation/tables/rotation-chord.md",
       "Families are aimed at the chord's error, and most turns are larger than the 45 degrees in a step that the article calls very fast.")
def chords(runs: Runs):
    found = runs.answers("rotation")
    names = list(rows(found, method="ofg k=8").scenario.unique())
    own = {f"`{name}`": rate(found, method="ofg k=8", scenario=name) for name in names}
    every, arcs, later = (or_reason(lambda: rate(found, method=m)) for m in ("brute-force", "ofg k=8 repairs=arcs", "ofg k=8 repairs=selection-times"))
    text = (f"By family, k = 8: {listed(own)}. All of them: k = 8 {rate(found, method='ofg k=8')}; all faces {every}: what these miss the chords miss, not the selection; "
            f"selections at several times alone {later}; arcs in place of chords alone {arcs}.")
    gentle = found[found.scenario.isin(["spin_side", "rotational_contact"]) & (found.level <= np.pi / 4)]  # levels of both are angles
    if len(gentle):
        text += f" Up to the article's 45 degrees in a step (`spin_side`, `rotational_contact`): k = 8 {rate(gentle, method='ofg k=8')}."
    return are_small(own.values()), f"missed with k=8: {spread(own)}", text


@claim("The pieces with the closest centres are the ones to test", CONCAVE, f"misses with k = 8 under {MISSES:.0%} in each concave family", "concavity/tables/concavity-misses.md concavity/tables/concavity-wrong.md",
       "Pieces by CoACD at its default threshold; where they are not quite the mesh, all pairs of pieces err too.")
def one_pair_of_pieces(runs: Runs):
    found = runs.answers("concavity")
    own = {f"`{name}`": rate(part, method="ofg k=8") for name, part in found.groupby("scenario") if has(part, "misses")}
    others = {name: or_reason(lambda: rate(found, method=m)) for name, m in (("one pair of pieces", "ofg k=8"), ("all pairs of pieces", "ofg k=8 concave=all-pairs"), ("all repairs", "ofg k=8 repairs=all"))}
    return are_small(own.values()), f"missed with k=8: {spread(own)}", f"By family, k = 8: {listed(own)}. All of them: {listed(others)}."


@claim("Some concave bodies work undivided, and some case will fail", f"{PROBLEMS}, first", "the undivided surface is right of some concave hits and misses others", "concavity/tables/concavity-wrong.md",
       "k = 8 of thousands of faces: the selection alone misses as well (`ofg k=64 concave=undivided` in the same table).")
def undivided(runs: Runs):
    found = rows(runs.answers("concavity"), method="ofg k=8 concave=undivided")
    missed = rate(found)
    first = found[found.outcome == "miss"].case
    text = f"The article's missing counterexample: `ofg-bench explain {first.iloc[0]} --run results/concavity`." if len(first) else "No case failed."
    return (HOLDS if 0 < missed.count < missed.total else FAILS), f"missed with k=8: {missed}", text


@claim("Faces alone tell (the article is silent on a body inside another)", BASIC, f"misses of contained bodies with all faces under {MISSES:.0%}", "gap/tables/gap-contained.md",
       "That a body inside another collides is this project's choice; methods of surfaces are meant to say otherwise.")
def contained(runs: Runs):
    found = rows(runs.answers("gap"), scenario="contained")
    inside = found[found.tags.str.contains('"place": "inside"')]
    every = rate(inside, method="brute-force")
    others = {m: or_reason(lambda: rate(inside, method=m)) for m in ("ofg k=8", "ofg k=8 repairs=all", "fcl-convex", "fcl-mesh")}
    return are_small([every]), f"missed with all faces: {every}", f"Others: {listed(others)}."


@claim("Units, place and shape do not matter (not in the article)", "-", f"wrong answers of k = 8 under {MISSES:.0%} in each family", "robustness/tables/robustness-scale.md robustness/tables/robustness-offset.md robustness/tables/robustness-aspect.md robustness/tables/robustness-ratio.md robustness/tables/robustness-tilt.md",
       "Slivers and size ratios go through the selection as well: compare all faces.")
def robust(runs: Runs):
    found = runs.answers("robustness")
    wrong = {m: {f"`{name}`": wrong_rate(rows(part, method=m)) for name, part in found.groupby("scenario")} for m in ("ofg k=8", "brute-force")}
    return are_small(wrong["ofg k=8"].values()), f"wrong with k=8: {spread(wrong['ofg k=8'])}", f"By family, k = 8: {listed(wrong['ofg k=8'])}. All faces: {listed(wrong['brute-force'])}."


def wrong_rate(part: pd.DataFrame) -> Rate:
    """Misses and false alarms of the certified cases answered."""
    counts = metrics.rates(part.assign(all=0), ["all"]).iloc[0]
    count, total = int(counts.misses + counts.false_alarms), int(counts.hits + counts.clears)
    return Rate(count, total, *metrics.wilson(count, total))


@claim("With all repairs nothing is missed (ours, not the article's)", "-", f"no miss, and its interval under {MISSES:.0%}, of each question (in part: of some)", "repairs/tables/repairs-overlap.md repairs/tables/repairs-translation.md repairs/tables/repairs-motion.md repairs/tables/repairs-ratio.md",
       "Repairs were made while looking at such families; the other runs have other draws of them.")
def mended(runs: Runs):
    found = runs.answers("repairs")
    base, all_ = "ofg k=8", "ofg k=8 repairs=all"
    by_question = {q: rate(found, method=all_, question=q) for q in found.question.unique()}
    lost = {m: set(part.case[part.outcome == "miss"]) for m, part in found.groupby("method")}
    alone = {m.split("repairs=")[1]: len(lost[base] - lost[m]) for m in lost if "repairs=" in m and "all" not in m.split("repairs=")[1].split("-")}
    without = {m.split("all-but-")[1]: len(lost[m] - lost[all_]) for m in lost if "all-but-" in m}
    text = f"As written {rate(found, method=base)} missed. Of these each repair alone finds: {listed(alone)}. Left out of all, it brings back: {listed(without)}."
    alarms = [or_reason(lambda: rate(found, "false alarms", method=m)) for m in (base, all_)]
    text += f" Price of all, net time over k = 8: {ratios_listed(lambda: runs.times('repairs'), all_, base, 'question')}. False alarms: as written {alarms[0]}, with all {alarms[1]}."
    none = [r.count == 0 for r in by_question.values()]
    verdict = OPEN if all(none) and not all(r.small for r in by_question.values()) else HOLDS if all(none) else PART if any(none) else FAILS
    return verdict, f"missed: {listed(by_question)}", text


# --- the engines

ENGINES = {  # heading -> distributions; sampled methods stand under a heading of their own
    "FCL": ("python-fcl",), "Bullet": ("pybullet",), "MuJoCo": ("mujoco",), "Coal": ("coal",), "Rapier": ("rapier3d",), "Parry": ("py-parry3d",),
    "IPC Toolkit": ("ipctk",), "Drake": ("drake",), "All pairs of faces, and OFG": ("ofg",)}
SAMPLING = "Sampling: a discrete test at n poses"
QUESTIONS = ("overlap", "translation", "motion")


def engine_of(label: str) -> str:
    known = registry.methods().get(label.split()[0])
    if known is None:
        return ""
    return SAMPLING if "-substeps" in label or "-naive" in label else next((h for h, names in ENGINES.items() if known.engine in names), known.engine)


def engine_rows(found: pd.DataFrame, heading: str) -> list[dict]:
    """A row per method of an engine: misses and false alarms by question, the family with the largest share of wrong answers, failures."""
    found = found[found.method.map({m: engine_of(m) == heading for m in found.method.unique()}).astype(bool)]
    if found.empty:
        return []
    counts, made = metrics.rates(found, ["method", "question"]).set_index(["method", "question"]), []
    judged = found[found.outcome.isin(["right", "miss", "false alarm", "conservative"])]
    wrong = judged.outcome.isin(["miss", "false alarm"]).groupby([judged.method, judged.scenario], sort=False).agg(["sum", "size", "mean"])
    for method in found.method.unique():
        row = {"method": method, "configuration": configuration_of(method)}
        for question in (q for q in QUESTIONS if (method, q) in counts.index):
            c = counts.loc[(method, question)]
            row[f"{question}, missed"] = str(Rate(int(c.misses), int(c.hits), c.miss_low, c.miss_high)) if c.hits else "-"
            row[f"{question}, false"] = str(Rate(int(c.false_alarms), int(c.clears), c.alarm_low, c.alarm_high)) if c.clears else "-"
        if method not in wrong.index.get_level_values(0):
            continue
        worst = wrong.loc[method].sort_values(["mean", "size"], ascending=False, kind="stable").iloc[0]
        row["worst family"] = f"{worst.name} {worst['sum']:.0f}/{worst['size']:.0f}" if worst["sum"] else "none"
        row["failed"] = str(int(counts.loc[method].failed.sum()))
        made.append(row)
    return made


def configuration_of(label: str) -> str:
    try:
        return registry.make(label)[0].configuration
    except (ImportError, ValueError):  # an engine that is not installed here
        return registry.methods()[label.split()[0]].configuration


def engine_lines(runs: Runs, heading: str) -> list[str]:
    """What the single experiments say of an engine's methods, a line each; those that are not there say so."""
    def line(what, say):
        said = or_reason(say)
        return [f"- {what}: {said}."] if said else []

    mine = lambda frame: [m for m in frame.method.unique() if engine_of(m) == heading and (frame[frame.method == m].status == "ok").any()]  # noqa: E731

    def gap():
        found = rows(runs.answers("gap"), scenario="feature_gap")
        said = {}
        for m in mine(found):
            part = rows(found, method=m)
            bad = part[part.outcome.isin(["miss", "false alarm"])]
            said[m] = f"{wrong_rate(part)}" + (f", up to |gap|/size {bad.level.abs().max():.0e}" if len(bad) else "")
        return listed(said)

    def turns():
        found = runs.answers("rotation")
        return listed({m: rate(found, method=m) for m in mine(found)})

    def through():
        found = runs.answers("tunnelling")
        return listed({m: rate(found, "tunnelled", method=m) for m in mine(found)})

    def when():
        found = runs.answers("impact")
        errors = metrics.times_of_impact(rows(found, method=mine(found)), ["method"]) if mine(found) else pd.DataFrame()
        return listed({e.method: f"median {e.median:.1e}, 95 % {e.p95:.1e}, latest {e.worst_late:.1e}, earliest {e.worst_early:.1e}, n={e.times}" for e in errors.itertuples()})

    def speed():
        found = rows(runs.file("native/native.csv"), situation="apart").pivot(index="method", columns="faces", values="native")
        if "ofg k=8" not in found.index:
            raise Missing("no ofg k=8 in run native")
        found = found.drop(index="ofg k=8") / found.loc["ofg k=8"]
        return listed({m: ", ".join(f"{f} faces {v:.2f}" for f, v in values.items()) for m, values in found.iterrows() if engine_of(m) == heading})

    def python_speed():
        times = runs.times("faces")
        methods = [m for m in times.method.unique() if engine_of(m) == heading and m != "ofg k=8"]
        return listed({m: ", ".join(f"{level:g} faces {r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]" for level, r in ratio(times, m, "ofg k=8", "level").iterrows()) for m in methods})

    def failures():
        said = {}
        for run in runs.finished:
            found = runs.answers(run)
            for (method, detail), n in found[found.status.isin(["error", "timeout"])].groupby(["method", "detail"]).size().items():
                if engine_of(method) == heading:
                    key = f"{method} ({detail[:60]})"
                    said[key] = said.get(key, 0) + int(n)
        return listed(said)

    def simulator():
        found = runs.file("stepping/stepping.parquet")
        first = {"Bullet": "bullet", "MuJoCo": "mujoco", "Rapier": "rapier", "All pairs of faces, and OFG": "ofg"}.get(heading)
        part = found[found.tunnelled.notna() & (found.contestant.str.split(r"[ -]", regex=True).str[0] == first)]
        part = part[~part.contestant.str.contains("rapier-cast|mujoco-speculative")]
        counts = part.groupby("contestant", sort=False)[["tunnelled", "runs"]].sum()
        return listed({r.Index: Rate(int(r.tunnelled), int(r.runs), *metrics.wilson(r.tunnelled, r.runs)) for r in counts.itertuples()})

    def at(name, path):
        return link(runs, path, name)

    wall, turn = "tunnelling/tables/tunnelling-", "rotation/tables/rotation-"
    return [*line(f"By signed gap, wrong ({at('table', 'gap/tables/gap-wrong.md')})", gap),
            *line(f"Walls, tunnelled ({at('straight', wall + 'straight.md')}, {at('turning', wall + 'turning.md')})", through),
            *line(f"Turns, missed ({at('side', turn + 'side.md')}, {at('contact', turn + 'contact.md')})", turns),
            *line(f"Time of impact, error in steps ({at('latest', 'impact/tables/impact-latest.md')})", when),
            *line(f"Time over that of ofg k=8, native, pairs apart ({at('both lanes', 'native/native.md')})", speed),
            *line(f"The same from Python, net, all pairs ({at('table', 'faces/tables/faces-ratio.md')})", python_speed),
            *line(f"As a simulator, got past in all scenes and speeds ({at('tables', 'stepping/tables')})", simulator),
            *line("Crashes and timeouts in all runs", failures)]


# --- the page


def about(runs: Runs) -> list[dict]:
    """A row per folder: what it asks, its size, when and from which commit it was made, how quiet the machine was."""
    made = []
    for run in sorted(p.name for p in runs.folder.iterdir() if p.is_dir() and p.name != "runs"):
        folder = runs.folder / run
        noted = next((json.loads((folder / n).read_text()) for n in ("manifest.json", "made.json") if (folder / n).exists()), {})
        try:
            question = Store(folder).config.about or Store(folder).config.title
        except StoreError:
            question = {"claims": "Misses and operations by size, depth and k (`python -m experiments.claims`).",
                        "native": "Both lanes side by side: the libraries asked from C++ and from Python."}.get(run, "")
        size, noise = "-", "-"
        if (folder / "observations.parquet").exists():
            found = runs.answers(run)
            size = f"{found.case.nunique()} cases x {found.method.nunique()}"
        if (folder / "timings.parquet").exists() and np.isfinite(value := metrics.noise(Store(folder))):
            noise = f"{100 * value:.0f} %"
        before = noted.get("before", {})
        made.append({"folder": f"[{run}]({run})", "what it asks": question, "size": size, "made (UTC)": noted.get("started", "-")[:16].replace("T", " "),
                     "commit": noted.get("commit", "-")[:9] + ("+" if noted.get("commit", "").endswith("+") else ""),
                     "machine": f"{before['cores']} cores, {before['processor']}" if before else "-", "noise": noise})
    return made


def grid(made: list[dict]) -> str:
    """A Markdown table; the columns in which any row has something."""
    columns = [c for c in dict.fromkeys(c for row in made for c in row) if any(row.get(c, "-") != "-" for row in made)]
    lines = [columns, ["---"] * len(columns), *([row.get(c, "-").replace("|", "\\|") for c in columns] for row in made)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def links(paths, runs: Runs) -> str:
    paths = [p.format(board=runs.board) for p in paths]
    return ", ".join(link(runs, p, Path(p).stem) for p in paths)


def link(runs: Runs, path: str, name: str) -> str:
    """A link to a file of the folder, or its name alone where it is not there."""
    return f"[{name}]({path})" if (runs.folder / path).exists() else name


def page(folder) -> str:
    """The whole page for a folder of runs."""
    runs = Runs(folder)
    found = [finding(asked, runs) for asked in CLAIMS]
    counts = pd.Series([f.verdict for f in found]).value_counts()
    summary = [{"": f"[{i}](#claim-{i})", "claim": f.claim.title, "verdict": f.verdict, "number": f.number, "where": links(f.claim.where[:1], runs)} for i, f in enumerate(found, 1)]
    parts = ["# Findings", "Made by `ofg-bench findings` from the runs in this folder at the end of `make reproduce`, which does it all again; no figure is typed. "
             "Counts are wrong/asked with 95 % Wilson intervals, over the certified cases that a method answered; times have 95 % bootstrap intervals. Cases of a family resemble each "
             f"other more than the intervals know. *{HOLDS.capitalize()}*: the rule under the claim is met; *{FAILS}*: its opposite is shown; *{PART}*: both, in parts; *{OPEN}*: too few cases; "
             f"*{UNMEASURED}*: a run is missing. Of {len(found)} claims: {', '.join(f'{n} {v}' for v, n in counts.items())}. After the claims: [the engines](#the-engines), [the runs](#the-runs).",
             grid(summary), "## The claims"]
    for i, f in enumerate(found, 1):
        said = f"**{f.verdict.capitalize()}**: {f.number}." + (f" {f.text}" if f.text else "")
        parts.append(f"### <a id=\"claim-{i}\"></a>{i}. {f.claim.title}\n{said} *Rule:* {f.claim.rule}. *Article:* {f.claim.section}. *Limits:* {f.claim.limits} *Tables:* {links(f.claim.where, runs)}.")
    made = about(runs)
    machines = sorted({row.pop("machine") for row in made} - {"-"})
    parts += ["## The engines", *engines(runs), "## The runs", grid(made),
              f"Machine: {'; '.join(machines) or 'not noted'}. Noise: how far the 90th percentile of the noise probe lies above its median, in the worst bin; times of a run above 25 % are to be taken "
              "again. Each run has its manifest.json (versions, machine, load), report.html (every wrong answer in 3D), tables, figures and rows. To redo a run: remove its folder, then "
              "`make reproduce`. This page alone: `ofg-bench findings results --into results/README.md`."]
    return "\n\n".join(parts) + "\n"


def engines(runs: Runs) -> list[str]:
    try:
        found = runs.answers(runs.board)
    except Missing as reason:
        return [f"not measured ({reason})"]
    parts = [f"Misses and false alarms in the run {link(runs, runs.board, runs.board)}, pooled over all its families as it weights them: families are aimed at difficulties, so these are not rates of everyday "
             "use. Worst family: the largest share wrong, misses and false alarms. Failed: crashes and timeouts. A method is asked only what it answers."]
    for heading in (*ENGINES, SAMPLING):
        made = engine_rows(found, heading)
        lines = engine_lines(runs, heading)
        body = grid(made) if made else f"not measured (run {runs.board} has no answers of it)."
        parts += [f"### {heading}\n{body}"] + (["\n".join(lines)] if lines else [])
    return parts

