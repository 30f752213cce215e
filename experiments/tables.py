"""The tables of a run: accuracy first, then time. Each is a frame of plain numbers (CSV) and of text (terminal, Markdown)."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Iterator

import numpy as np
import pandas as pd

from baselines import registry
from ofg import QUESTIONS

from . import metrics, piece_truth, scenarios
from .config import ConfigError, RunConfig, TableChoice, closest
from .inside import inside
from .methods import method_table
from .rows import filled
from .store import Store
from .table import MARK, Table, latex, marked, markdown, texts
from .timing import SIZES, size_of

__all__ = ["Table", "build", "check", "latex", "markdown", "save", "texts"]

BANDS = (1e-2, 1e-4, 1e-7)  # of |gap| / size, that tables are split by


def build(store: Store) -> Iterator[Table]:
    """Every table of the run that has rows, in reading order: first those that its configuration asks for."""
    if store.config.stepping:
        yield from stepping_tables(store)
        return
    found = metrics.outcomes(store)
    both = metrics.with_pieces(store, found)
    particular = [chosen_table(store, both if choice.value in WITH_PIECES else found, choice) for choice in store.config.tables]
    yield from (table for table in particular if len(table.text))
    yield from (replace(table, headline=table.headline and not particular) for table in general(store, found, both))


def general(store: Store, found: pd.DataFrame, both: pd.DataFrame) -> Iterator[Table]:
    """The tables that every run has. both: found, and the pieces' own error."""
    makers = [truth_table(store), method_table(store, found), *([leaderboard(found)] if found.question.nunique() > 1 else [])]
    for question in found.question.unique():
        part = found[(found.question == question) & (found.detail != f"does not answer {question}")]
        also = both[(both.question == question) & (both.detail != f"does not answer {question}")]
        makers += [accuracy_table(also, question), touching_table(part, question)]
        makers.append(scenario_table(also, question))
        makers += [gap_table(part)] if question == "overlap" else [speed_table(part, question), time_table(part, question)]
    makers.append(trouble_table(found))
    if store.has("timings.parquet"):
        makers += list(cost_tables(store))
    yield from (table for table in makers if len(table.text))


def save(store: Store, tables: list[Table]) -> None:
    """Write each table as CSV, Markdown and LaTeX; files of tables that are not made any more go. Outside: see `inside`."""
    for table in tables:
        inside(store.folder, "tables", f"{table.name}.csv")
    for path in inside(store.folder, "tables").glob("*"):
        if path.suffix in (".csv", ".md", ".tex") and path.stem not in {table.name for table in tables}:
            path.unlink()
    for table in tables:
        for suffix, text in texts(table).items():
            store.write_text(text, "tables", f"{table.name}.{suffix}")


COLUMNS = ("level", "scenario", "question", "situation", "faces", "band")
COUNTS = {  # value of a table -> columns of metrics.rates, name of its interval, and what it says
    "misses": ("misses", "hits", "miss", "Certified hits answered clear, of those answered."),
    "false alarms": ("false_alarms", "clears", "alarm", "Certified clears answered hit, of those answered, beyond the method's documented margin."),
    "wrong": ("wrong", "judged", "wrong", "Misses and false alarms, of the certified cases answered."),
    "tunnelled": ("tunnelled", "can_tunnel", "tunnel", "Misses, of the certified hits answered whose start and end are both clear."),
    "answered": ("answered", "asked", "answered", "Cases answered, of those asked.")}
WITH_PIECES = COUNTS.keys() - {"answered"}  # values that the pieces' own error has
IN_NOISE = ("No ratio (-) where the reference's net time lies within the noise of its floor, the "
            "interquartile range of the floor's rounds, in half of the cases or more; such cases "
            "are left out elsewhere.")
CLOCKED = ("net time", "gross time", "build time", "ratio")


def check(config: RunConfig) -> None:
    """ConfigError for a table that names what the run does not have."""
    families = {c.name: scenarios.get(c.name) for c in config.scenarios}
    for choice in config.tables:
        where = f"The table '{choice.name}'"
        for name in choice.scenarios:
            if name not in families:
                raise ConfigError(f"{where}: its scenario '{name}' is not one of the run{closest(name, families)}; the run has {', '.join(families)}.")
        if choice.question not in ("", *QUESTIONS):
            raise ConfigError(f"{where}: there is no question '{choice.question}'; the questions are {', '.join(QUESTIONS)}.")
        if choice.value in CLOCKED and not config.timing.cases:
            raise ConfigError(f"{where}: '{choice.value}' needs times; set timing.cases to more than 0.")
        tags = {t for n in choice.scenarios or families for t in families[n].case(config.seed, families[n].levels[0], 0).tags}
        if choice.columns not in (*COLUMNS, *tags):
            raise ConfigError(f"{where}: columns = '{choice.columns}' is neither one of {', '.join(COLUMNS)} nor a tag of its scenarios "
                              f"({', '.join(sorted(tags)) or 'which have none'}).")


def chosen_table(store: Store, found: pd.DataFrame, choice: TableChoice) -> Table:
    """A table that the configuration asks for: a row per method, a column per value of choice.columns."""
    part = found[found.scenario.isin(choice.scenarios or set(found.scenario)) & found.question.isin([choice.question] if choice.question else QUESTIONS)]
    column, order = _column(part, choice.columns)
    part = part.assign(column=column).dropna(subset=["column"])
    part = part[~part.detail.str.startswith("does not answer", na=False)]
    if choice.value in COUNTS:
        numbers, cell, note = _counted(part, choice.value)
    elif choice.value in CLOCKED:
        numbers, cell, note = _clocked(store, part, choice.value)
    else:
        numbers, cell, note = _off(part, choice.value)
    numbers = numbers.rename(columns={"column": choice.columns})
    text = _pivot(numbers, choice.columns, cell, order)
    return Table(choice.name, choice.title, " ".join(filter(None, [choice.note, note])), numbers, text, choice.headline, choice=choice)


def _column(part: pd.DataFrame, name: str) -> tuple[pd.Series, list[str]]:
    """The column of each row, and the columns in their order."""
    if name == "band":
        return gap_bands(part.relative_gap)
    if name == "faces":
        return size_of(part.faces), [title for _, title in SIZES]
    if name == "situation":
        return part.situation, ["deep", "near", "apart", "hit", "clear"]
    values = part[name] if name in COLUMNS else part.tags.map({text: json.loads(text).get(name) for text in part.tags.unique()})
    found = values.dropna().unique()
    if all(isinstance(v, (int, float, np.number)) for v in found):
        return values.map(lambda v: f"{v:g}", na_action="ignore"), [f"{v:g}" for v in sorted(found)]
    return values, list(found) if name in ("scenario", "question") else sorted(found)


def _counted(part: pd.DataFrame, value: str):
    count, total, interval, note = COUNTS[value]
    counts = metrics.rates(part, ["method", "column"])
    counts["wrong"], counts["judged"] = counts.misses + counts.false_alarms, counts.hits + counts.clears
    if f"{interval}_low" not in counts:
        bounds = [metrics.wilson(c, t) for c, t in zip(counts[count], counts[total])]
        counts[f"{interval}_low"], counts[f"{interval}_high"] = zip(*bounds) if bounds else ((), ())
    numbers = counts[["method", "column", *dict.fromkeys([count, total, f"{interval}_low", f"{interval}_high", "asked", "answered", "uncertain", "conservative"])]]
    return numbers, lambda r: _of(getattr(r, count), getattr(r, total)), f"{note} 95 % Wilson intervals in the CSV.{piece_truth.note(part)}"


def _clocked(store: Store, part: pd.DataFrame, value: str):
    times = metrics.case_costs(store).merge(part[["case", "method", "column"]], on=["case", "method"])
    state = _state(store)
    if value == "ratio":
        reference = _reference(store.config)
        note = (f"Net time over that of {reference}: median of the ratios case by case, 95 % bootstrap "
                f"interval. Above 1: slower. {IN_NOISE} {state}")
        found = metrics.ratios(times, reference, ["column"]).dropna(subset=["ratio"])
        return found, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]", note
    column, what = {"net time": ("net", "Microseconds per query from Python, less the method's floor; medians over cases"),
                    "gross time": ("ns", "Microseconds per query from Python, floor included; medians over cases"),
                    "build time": ("build_ns", "Microseconds to build for a query (a body that was built before is mostly kept); medians over cases")}[value]
    return metrics.medians(times, column, ["method", "column"]), lambda r: _microseconds(r.median), f"{what}; 95 % bootstrap intervals in the CSV. {state}"


def _off(part: pd.DataFrame, value: str):
    if value == "time error":
        sized = part[part.error.notna()].assign(size_of_error=lambda t: t.error.abs())
        note = "Beyond the certified bracket, as a share of the step, where both say hit; 95 % bootstrap intervals in the CSV."
        return metrics.medians(sized, "size_of_error", ["method", "column"]), lambda r: f"{r.median:.1e}" if r.median else "0", note
    errors = metrics.times_of_impact(part, ["method", "column"])
    worst = "worst_late" if value == "latest" else "worst_early"
    return errors, lambda r: f"{getattr(r, worst):.1e}" if getattr(r, worst) else "0", "Worst error beyond the certified bracket, as a share of the step, where both say hit."


def stepping_tables(store: Store) -> Iterator[Table]:
    """A table per scene: what got past, by thicknesses per step."""
    rows = store.read("stepping.parquet")
    told = rows[rows.tunnelled.notna()]
    for scene, part in told.groupby("scene", sort=False):
        part = part.assign(travelled=[f"{t:g}" for t in part.travel])
        text = part.assign(cell=[_of(r.tunnelled, r.runs) for r in part.itertuples()]).pivot(index="contestant", columns="travelled", values="cell")
        text = text.reindex(index=part.contestant.unique(), columns=part.travelled.unique()).rename_axis(columns=None)
        text["us/step"] = part.groupby("contestant").us_per_step.median().map(lambda v: f"{v:.1f}")
        yield Table(f"stepping-{scene.replace(' ', '-')}", f"Got past: {scene}.", "Tunnelled of the runs, by thicknesses travelled per step; each run has its own start phase. 95 % "
                    "Wilson intervals in the CSV. us/step: median time of a step.", part.drop(columns=["travelled", "detail"]), text.reset_index(), True)
    lost = rows[rows.tunnelled.isna()][["scene", "contestant", "detail"]]
    if len(lost):
        yield Table("unanswered", "What did not run, and why.", "None of these is counted as tunnelled.", lost, lost.astype(str))


def _reference(config: RunConfig) -> str:
    if config.timing.reference:
        return config.timing.reference
    try:
        return registry.make(config.asked[0])[0].label
    except (ValueError, ImportError):  # a method whose file is not loaded
        return config.asked[0]


def truth_table(store: Store) -> Table:
    cases = filled(store.read("cases.parquet"))
    rows = []
    for name, group in cases.groupby("scenario", sort=False):
        count = group.label.value_counts()
        rows.append({"scenario": name, "question": group.question.iloc[0], "cases": len(group), "hit": count.get("hit", 0), "clear": count.get("clear", 0),
                     "touching": int(group.touching.sum()), "uncertain": count.get("uncertain", 0),
                     "drawn again": int(group.attempt.sum()),
                     "precision": " ".join(sorted(group.precision.unique())), "exposes": _exposes(name)})
    frame = pd.DataFrame(rows)
    text, touching = frame.astype(str), ""
    if frame.touching.any():
        touching = ("Touching ones, which share a boundary point without overlapping, count as clear here, and "
                    "are in no rate. ")
    else:
        text = text.drop(columns="touching")
    caption = (f"Uncertain cases are in no rate. {touching}'Drawn again': draws thrown away because the step "
               "began in overlap. Precision: float32 where all numbers of a case are rounded to it.")
    return Table("truth", "Cases and their certified labels.", caption, frame, text, True,
                 ("exposes", "precision", "drawn again"))


def leaderboard(found: pd.DataFrame) -> Table:
    """All questions at once: a row per method, the least share of wrong answers first."""
    counts = metrics.rates(found, ["method"])
    counts["wrong"], counts["judged"] = counts.misses + counts.false_alarms, counts.hits + counts.clears
    counts["wrong_low"], counts["wrong_high"] = zip(*(metrics.wilson(w, n) for w, n in zip(counts.wrong, counts.judged)))
    counts = counts.assign(share=counts.wrong / counts.judged).sort_values(["share", "wrong_high"], kind="stable", na_position="last")
    single = metrics.out_of_their_depth(found)
    text = pd.DataFrame({"method": marked(counts.method, single),
                         "answered": [_share(a, n) for a, n in zip(counts.answered, counts.asked)],
                         "wrong": _fraction(counts, "wrong", "judged"), "95 %": _interval(counts, "wrong")})
    each = metrics.rates(found, ["method", "question"])
    for question in found.question.unique():
        kinds = (("misses", "hits", "missed"), ("false_alarms", "clears", "false"))
        own = each[each.question == question].set_index("method")[[c for kind in kinds for c in kind[:2]]].reindex(counts.method, fill_value=0)
        for count, total, name in kinds:
            counts[f"{question}_{count}"], counts[f"{question}_{total}"] = own[count].to_numpy(), own[total].to_numpy()
            text[f"{question} {name}"] = _fraction(own, count, total)
    text["in margin"] = counts.conservative.astype(str).to_list()
    numbers = counts[["method", "asked", "answered", "wrong", "judged", "wrong_low", "wrong_high", "conservative", *(c for c in counts if c.startswith(tuple(QUESTIONS)))]]
    return Table("leaderboard", "Leaderboard, all questions.", "Misses and false alarms of the certified cases answered, least share first, 95 % Wilson intervals "
                 "in percent. A method that answers fewer cases had fewer chances to be wrong: compare within a column. In margin: as in the accuracy tables."
                 + _single(single),
                 numbers, text, False, ("95 %", "in margin"))


def accuracy_table(part: pd.DataFrame, question: str) -> Table:
    counts = metrics.rates(part, ["method"])
    single = metrics.out_of_their_depth(part)
    text = pd.DataFrame({"method": marked(counts.method, single),
                         "answered": [_share(a, n) for a, n in zip(counts.answered, counts.asked)],
                         "misses": _fraction(counts, "misses", "hits"), "95 %": _interval(counts, "miss")})
    if question != "overlap":
        text["tunnelled"] = _fraction(counts, "tunnelled", "can_tunnel")
    text["false alarms"] = _fraction(counts, "false_alarms", "clears")
    text["95 % "] = _interval(counts, "alarm")  # the blank keeps the two names apart
    text["in margin"] = counts.conservative.astype(str)
    tunnelling = " Tunnelled: misses of sweeps whose start and end are both clear." if question != "overlap" else ""
    return Table(f"accuracy-{question}", f"Accuracy, {question}.", "Over the certified cases that a method answered; 95 % Wilson intervals in percent."
                 f"{tunnelling} In margin: hits reported within the method's documented margin, not counted as "
                 f"false alarms.{_single(single)}{piece_truth.note(part)}", counts, text, True, ("95 %", "95 % ", "in margin", "tunnelled"))


def touching_table(part: pd.DataFrame, question: str) -> Table:
    """What each method said where the bodies share a point and no more; without such cases no rows."""
    counts = metrics.rates(part[part.touching], ["method"])
    clears = counts.touching - counts.touching_hits
    shown = {"cases": counts.asked, "answered": counts.touching, "said hit": counts.touching_hits,
             "said clear": clears}
    text = pd.DataFrame({"method": counts.method, **{k: v.astype(str) for k, v in shown.items()}})
    numbers = counts[["method", "asked", "answered", "touching_hits"]].assign(touching_clears=clears)
    caption = ("The bodies are certified to touch without overlapping: neither answer is wrong, and "
               "these cases are in no rate.")
    return Table(f"touching-{question}", f"Touching, {question}.", caption, numbers, text, True)


def _single(names: set[str]) -> str:
    """The line under a table that explains its marks."""
    if not names:
        return ""
    return (f"{MARK}: computes or holds bodies in single precision, and was asked cases whose numbers are "
            "not rounded to it.")


def scenario_table(part: pd.DataFrame, question: str) -> Table:
    counts = metrics.rates(part, ["method", "scenario"])
    counts["wrong"] = counts.misses + counts.false_alarms
    counts["judged"] = counts.hits + counts.clears
    return Table(f"scenarios-{question}", f"Wrong answers by scenario, {question}.", "Misses and false alarms of the certified cases answered; - where "
                 f"a method answered none.{piece_truth.note(part)}", counts[["method", "scenario", "misses", "false_alarms", "conservative", "hits", "clears"]],
                 _pivot(counts, "scenario", lambda r: _of(r.wrong, r.judged)))


def gap_table(part: pd.DataFrame) -> Table:
    bands, order = gap_bands(part.relative_gap)
    part = part.assign(band=bands).dropna(subset=["band"])
    counts = metrics.rates(part, ["method", "band"])
    counts["wrong"], counts["judged"] = counts.misses + counts.false_alarms, counts.hits + counts.clears
    return Table("gap-overlap", "Wrong answers by signed gap over size, overlap.", "Left of 0 the bodies overlap (misses), right of it they are apart (false alarms).",
                 counts[["method", "band", "misses", "false_alarms", "conservative", "hits", "clears"]],
                 _pivot(counts, "band", lambda r: _of(r.wrong, r.judged), order))


def gap_bands(relative_gap: pd.Series) -> tuple[pd.Series, list[str]]:
    """The band of each signed relative gap, and the bands from deep to far."""
    edges = [-np.inf, *(-b for b in BANDS), 0.0, *reversed(BANDS), np.inf]
    bounds = [f"{e:.0e}".replace("e-0", "e-") if e else "0" for e in edges[1:-1]]
    names = [f"below {bounds[0]}", *(f"{low} to {high}" for low, high in zip(bounds, bounds[1:])), f"above {bounds[-1]}"]
    return pd.cut(relative_gap, edges, labels=names).astype(object), names


def speed_table(part: pd.DataFrame, question: str) -> Table:
    """Tunnelling along the axis of the first scenario whose axis is a speed over a thickness."""
    walls = [n for n in part.scenario.unique() if "thickness" in _axis(n)]
    part = part[part.scenario.isin(walls)]
    counts = metrics.rates(part, ["method", "level"]) if len(part) else pd.DataFrame(columns=["method", "level"])
    levels = [f"{v:g}" for v in sorted(part.level.unique())]
    counts["speed"] = [f"{v:g}" for v in counts.level]
    return Table(f"tunnelling-{question}", f"Misses against speed over thickness, {question}.", f"Scenario {', '.join(walls)}; columns are thicknesses travelled in the step.",
                 counts, _pivot(counts, "speed", lambda r: _of(r.misses, r.hits), levels) if len(counts) else counts)


def time_table(part: pd.DataFrame, question: str) -> Table:
    errors = metrics.times_of_impact(part, ["method"])
    text = pd.DataFrame({"method": errors.method, "times": errors.times.astype(str)})
    for column, title in (("median", "median |error|"), ("p95", "95 %"), ("worst_late", "latest"), ("worst_early", "earliest")):
        text[title] = [f"{v:.1e}" if v else "0" for v in errors[column]]
    text["late"], text["early"] = errors.late.astype(str), errors.early.astype(str)
    return Table(f"time-of-impact-{question}", f"Time of impact, {question}.", "Error beyond the certified bracket, as a share of the step, where both say hit; late is positive.", errors, text)


def trouble_table(found: pd.DataFrame) -> Table:
    lost = found[(found.status != "ok") & ~found.detail.str.startswith("does not answer")].assign(detail=lambda t: t.detail.str.slice(0, 60))
    counts = lost.groupby(["method", "status", "detail"], sort=False).size().rename("cases").reset_index()
    return Table("unanswered", "What was not answered, and why.", "None of these is counted as a miss.", counts, counts.astype(str))


def cost_tables(store: Store) -> Iterator[Table]:
    state = _state(store)
    note = (f"Microseconds per query from Python: net (gross). Net is gross less the method's floor, its own call on two tetrahedra far "
            f"apart. Columns: faces of the larger body. Medians over cases of medians over rounds; poses differ from call to call. {state}")
    for question, part in metrics.costs(store, ("question", "faces")).groupby("question", sort=False):
        yield Table(f"cost-{question}", f"Time, {question}.", note, part, _by_faces(part, lambda r: _cost(r.net, r.gross)), headline=True)
    for (question, situation), part in metrics.costs(store).groupby(["question", "situation"], sort=False):
        yield Table(f"cost-{question}-{situation}", f"Time, {question}, {situation}.", note, part, _by_faces(part, lambda r: _cost(r.net, r.gross)))
    reference = _reference(store.config)
    for (question, situation), part in metrics.paired_ratios(store, reference).groupby(["question", "situation"], sort=False):
        yield Table(f"ratio-{question}-{situation}", f"Net time over that of {reference}, {question}, {situation}.", "Median of the ratios case by case on the cases both "
                    f"answered, 95 % bootstrap interval. Above 1: slower. {IN_NOISE} {state}", part, _by_faces(part, lambda r: f"{r.ratio:.2g} [{r.low:.2g}, {r.high:.2g}]"))


def _state(store: Store) -> str:
    """What to know of the state that the times were taken in."""
    noise = metrics.noise(store)
    state = f"Noise probe: 90th percentile {100 * noise:.0f} % above its median" + (": THIS RUN WAS DISTURBED." if noise > 0.25 else ".")
    lost = metrics.lost(store)
    return f"{state} Without times, because the process died or hung: {'; '.join(lost)}." if lost else state


def _by_faces(part: pd.DataFrame, cell) -> pd.DataFrame:
    wide = part.assign(cell=[cell(r) for r in part.itertuples()]).pivot(index="method", columns="faces", values="cell")
    order = [name for _, name in SIZES if name in wide.columns]
    return wide.reindex(index=part.method.unique(), columns=order).fillna("-").rename_axis(columns=None).reset_index()


def _cost(net: float, gross: float) -> str:
    return f"{_microseconds(net)} ({_microseconds(gross)})"


def _microseconds(ns: float) -> str:
    return f"{ns / 1e3:.2f}" if ns < 1e4 else f"{ns / 1e3:.1f}" if ns < 1e5 else f"{ns / 1e3:.0f}"


def _pivot(counts: pd.DataFrame, column: str, cell, order=None) -> pd.DataFrame:
    counts = counts.assign(cell=[cell(r) for r in counts.itertuples()])
    wide = counts.pivot(index="method", columns=column, values="cell")
    order = [c for c in (order or counts[column].unique()) if c in wide.columns]
    wide = wide.reindex(index=counts.method.unique(), columns=order).fillna("-")
    return wide[(wide != "-").any(axis=1)].rename_axis(columns=None).reset_index()


def _of(count: int, total: int) -> str:
    return f"{count}/{total}" if total else "-"


def _fraction(counts: pd.DataFrame, count: str, total: str) -> list[str]:
    return [_of(c, t) for c, t in zip(counts[count], counts[total])]


def _interval(counts: pd.DataFrame, name: str) -> list[str]:
    """Wilson interval in percent: '0.8-7.1'."""
    return ["-" if np.isnan(low) else f"{100 * low:.1f}-{100 * high:.1f}" for low, high in zip(counts[f"{name}_low"], counts[f"{name}_high"])]


def _share(count: int, total: int) -> str:
    return "all" if count == total else f"{count}/{total}"


def _axis(name: str) -> str:
    known = scenarios.scenarios()
    return known[name].axis if name in known else ""


def _exposes(name: str) -> str:
    known = scenarios.scenarios()
    return known[name].exposes if name in known else ""
