"""The command line: ofg-bench."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Optional

import typer
from rich.console import Console
from rich.table import Table as Grid

from baselines import registry
from ofg import BodyError

from . import config as configuration
from . import given, scenarios
from .given import markup
from .machine import ERRNOS, MachineError
from .reading import opened, reading
from .store import Store, StoreError
from .studies.native.command import native

app = typer.Typer(no_args_is_help=True, rich_markup_mode="markdown", pretty_exceptions_enable=False, add_completion=False,
                  help="""Benchmark collision detection on cases whose true answers are certified.

A run is one folder: `ofg-bench run quick` makes cases, certifies them, asks every method, takes times and prints the tables.
`ofg-bench list` shows what there is; a configuration of your own starts from `ofg-bench preset quick > mine.toml`.""")
console = Console(width=None if sys.stdout.isatty() else 160)  # nobody folds what goes into a file
Run = Annotated[Path, typer.Argument(help="folder of a run")]
Workers = Annotated[Optional[int], typer.Option(min=1, max=256, help="processes for all but the timing [default: one per core]")]
SkipMissing = Annotated[bool, typer.Option("--skip-missing", help="leave rows of engines that are not installed empty")]
Trust = Annotated[bool, typer.Option("--trust", help="run the Python files that the run names as its own methods and scenarios")]
Methods = Annotated[Optional[list[Path]], typer.Option("--methods", help="Python file with methods of your own (METHODS = [...]); may be repeated")]
Scenarios = Annotated[Optional[list[Path]], typer.Option("--scenarios", help="Python file with scenarios of your own (SCENARIO = ...); may be repeated")]


@app.command("list")
def list_(methods: Methods = None, scenarios_: Scenarios = None) -> None:
    """Show scenarios, methods (what each can answer, and whether its engine is installed), experiments and presets."""
    _extend(methods, scenarios_)
    _print_grid("Scenarios", ("name", "question", "precision", "difficulty", "levels", "exposes"),
                [(s.name, s.question, s.precision, s.axis, _levels(s.levels), s.exposes)
                 for s in scenarios.scenarios().values()])
    heads = ("name", "configuration", "questions", "bodies", "tests", "precision", "parameters", "engine")
    _print_grid("Methods", heads,
                [(m.name, m.configuration, " ".join(q[0] for q in ("overlap", "translation", "motion") if q in m.questions),
                  ", ".join(sorted(m.bodies)), "solid" if m.solid else "surface", m.precision,
                  " ".join(f"{k}={v}" for k, v in m.parameters.items()),
                  "not installed" if registry.available(m) else m.engine) for m in registry.methods().values()])
    console.print("Questions: [b]o[/b]verlap at one pose pair, [b]t[/b]ranslation, [b]m[/b]otion (turning and translating).")
    console.print()
    experiments = {name: configuration.load(name) for name in configuration.experiments()}
    _print_grid("Experiments", ("name", "title", "what it asks"), [(name, c.title, c.about) for name, c in experiments.items()])
    _print_grid("Presets", ("name", "what it is"), [(name, configuration.load(name).about) for name in configuration.presets()],
                "Each experiment and each preset runs alone: ofg-bench run NAME. ofg-bench preset NAME > mine.toml gives a copy to change.")


@app.command()
def preset(name: Annotated[str, typer.Argument(help="of a preset or an experiment")]) -> None:
    """Print the configuration of a preset or experiment, to be changed and run: ofg-bench preset quick > mine.toml"""
    configuration.load(name)
    print(configuration.path_of(name).read_text(), end="")


@app.command()
def run(
    source: Annotated[str, typer.Argument(metavar="CONFIG", help="the name of a preset or experiment, or the path of a .toml file")],
    out: Annotated[Optional[Path], typer.Option(help="folder of the run [default: results/runs/CONFIG]")] = None,
    workers: Workers = None,
    seed: Annotated[Optional[int], typer.Option(min=0, max=configuration.MOST_SEED, help="another seed than the configuration's")] = None,
    skip_missing: SkipMissing = False,
    methods: Methods = None,
    scenarios_: Scenarios = None,
) -> None:
    """Run a configuration and print its tables. Said again, it goes on where it was interrupted."""
    from . import entries

    chosen = configuration.load(source)
    changes = {"seed": chosen.seed if seed is None else seed,
               "method_files": chosen.method_files + tuple(map(str, methods or ())),
               "scenario_files": chosen.scenario_files + tuple(map(str, scenarios_ or ()))}
    chosen = chosen.model_copy(update=changes)
    entries.check(chosen, _named(source))
    _run(chosen, out or Path("results", "runs", Path(source).stem), workers, skip_missing)


@app.command()
def reproduce(
    names: Annotated[Optional[list[str]], typer.Argument(help="experiments and presets [default: every experiment of the catalogue, then standard]")] = None,
    into: Annotated[Path, typer.Option(help="folder of the run folders")] = Path("results"),
    workers: Workers = None,
) -> None:
    """Run experiments one after another, each into its own folder, build all tables, figures and reports anew, and write the findings.

    What is finished already is not run again: remove its folder if it shall be. Said again after an interruption, it goes on where it stopped.
    """
    from . import entries, runner

    everything = not names
    names = names or [*configuration.experiments(), "standard"]
    chosen = {name: configuration.load(name) for name in names}
    for name, config in chosen.items():
        entries.check(config, _named(name))
    for i, (name, config) in enumerate(chosen.items(), 1):
        console.print(f"[bold]{i} of {len(names)}: {name}[/] {markup(config.title)}", highlight=False)
        _say_missing(config)
        runner.run(config, into / name, workers)
    if everything:
        from . import sizes

        console.print("[bold]and sizes: misses and operations by size, depth and k[/]")
        sizes.run(into / "sizes")
    findings(into, into / "README.md")
    findings(into, objections=into / "OBJECTIONS.md")
    console.print(f"All of it is in {markup(into)}: tables, figures, report.html, manifest.json and the rows of each run.")


@app.command()
def findings(
    results: Annotated[Path, typer.Argument(help="folder of run folders, as reproduce makes it")] = Path("results"),
    into: Annotated[Optional[Path], typer.Option(help="write the page here [default: print it]")] = None,
    objections: Annotated[Optional[Path], typer.Option(help="write the page of objections and answers here, and no findings")] = None,
) -> None:
    """Say what the runs of a folder found: each claim of the article with its verdict, then each engine. What is missing is said to be."""
    from . import findings as found

    if not results.is_dir():
        raise configuration.ConfigError(f"The folder {results} does not exist. Name the one that ofg-bench reproduce made.")
    with reading(results):
        page = found.page(results) if objections is None else found.objections.page(found.Runs(results))
    into = into or objections
    if into is None:
        print(page, end="")
        return
    into.write_text(page)
    console.print(f"The page is {markup(into)}.")


@app.command()
def resume(run_: Run, workers: Workers = None, skip_missing: SkipMissing = False) -> None:
    """Finish a run that was interrupted. It ends as if it had not been."""
    from . import entries

    config = Store(run_).config
    entries.check(config, f"The configuration {run_ / 'config.json'}")
    _run(config, run_, workers, skip_missing)


def _run(config: configuration.RunConfig, folder: Path, workers: int | None, skip_missing: bool) -> None:
    from . import runner, silence

    _say_missing(config)
    made = runner.run(config, folder, workers, skip_missing)
    for table in made:
        if table.headline:
            _print_table(table)
    if others := ", ".join(table.name for table in made if not table.headline):
        console.print(f"{len(made)} tables were made; not printed here: {others}. Print them with: ofg-bench tables {markup(folder)} --only NAME\n")
    if config.stepping:
        console.print(f"Tables (CSV, Markdown, LaTeX) are in {markup(folder / 'tables')}, all counts in {markup(folder / 'stepping.parquet')}.")
    else:
        console.print(f"Tables (CSV, Markdown, LaTeX) are in {markup(folder / 'tables')}, figures (SVG, PNG) in {markup(folder / 'figures')}; every case with its "
                      f"certificate in {markup(folder / 'cases.parquet')}, every answer in {markup(folder / 'observations.parquet')}.")
        for warning in silence.warnings(Store(folder)):
            Console(stderr=True, width=console.width).print(f"[yellow]{markup(warning)}[/]", highlight=False)


@app.command()
def tables(
    run_: Run,
    only: Annotated[str, typer.Option(help="print only tables whose name contains this")] = "",
    into: Annotated[Optional[Path], typer.Option(help="also put them into this Markdown page, between its markers `<!-- table NAME -->` and `<!-- end -->`")] = None,
    trust: Trust = False,
) -> None:
    """Build the tables of a finished run anew from its rows, and print them."""
    from . import outcome, readme
    from . import tables as made

    with reading(run_):
        store = opened(run_, trust)
        found = list(made.build(store))
        made.save(store, found)
        if store.has("observations.parquet"):
            outcome.save(store)
    for table in found:
        if only in table.name:
            _print_table(table)
    if into:
        into.write_text(readme.fill(given.text(into, "The page"), run_ / "tables"))


@app.command()
def compare(
    first: Annotated[Path, typer.Argument(help="folder of a run: before")],
    second: Annotated[Path, typer.Argument(help="folder of a run: after")],
    show: Annotated[int, typer.Option(min=0, help="print at most so many answers that moved")] = 40,
    accept: Annotated[bool, typer.Option("--accept", help="afterwards make SECOND the reference: FIRST then holds its answers and labels, without certificates and times")] = False,
    trust: Trust = False,
) -> None:
    """Say what changed from one run to another: in accuracy, to the case, and in time, paired by case.

    Exit code 0 if accuracy is identical over the same cases and methods, 1 if not.
    """
    from . import compare as comparing

    if accept and not Store(first).has("config.json"):
        with reading(second):
            comparing.reference(opened(second, trust), Store(first))
        console.print(f"{markup(first)} is now the reference, made from {markup(second)}.")
        return
    with reading(first, second):
        before, after = opened(first, trust), opened(second, trust)
        found = comparing.compare(before, after)
    for what, (left, right) in (("cases", found.only_cases), ("methods", found.only_methods)):
        for names, folder in ((left, first), (right, second)):
            if names:
                console.print(f"[bold]Only in {markup(folder)}[/]: {len(names)} {what}: {markup(', '.join(names[:8]))}{', ...' if len(names) > 8 else ''}", highlight=False)
    if found.remade:
        console.print(f"{len(found.remade)} cases have other bodies, poses or motions in {markup(second)} and are not compared; {len(found.changed)} of them "
                      f"differ by more than rounding, so they ask a different question: "
                      f"{markup(', '.join(found.remade[:8]))}{', ...' if len(found.remade) > 8 else ''}", highlight=False)
    for title, frame in (("Labels that moved: the truth of the two runs differs.", found.labels), ("Answers that moved.", found.answers)):
        if len(frame):
            _print_grid(title, frame.columns, list(frame.head(show).itertuples(index=False)), f"{min(show, len(frame))} of {len(frame)}.")
    if len(found.rates):
        pairs = [c.removesuffix("_before") for c in found.rates.columns if c.endswith("_before")]
        rows = [(r["question"], r["method"], *(_moved(r[f"{c}_before"], r[f"{c}_after"]) for c in pairs)) for r in found.rates.to_dict("records")]
        _print_grid("Accuracy that moved, over the cases of both runs.", ("question", "method", *(c.replace("_", " ") for c in pairs)), rows, "before -> after.")
    if len(found.times):
        _print_grid("Time, second run over first.", found.times.columns, [(r.question, r.method, f"{r.ratio:.3g}", f"{r.low:.3g}", f"{r.high:.3g}", r.pairs)
                    for r in found.times.itertuples()], "Median of the gross ratios case by case, 95 % bootstrap interval. Two runs are two states of the machine: read it "
                    "against the methods that did not change.")
    console.print(f"Accuracy is {'identical' if found.identical else 'NOT identical'}: {len(found.answers)} of {found.compared} answers moved, {len(found.labels)} "
                  f"labels moved{'' if found.same_content else '; the runs differ in their cases or methods'}"
                  f"{f'; {len(found.changed)} cases ask a different question' if found.changed else ''}.", highlight=False)
    if accept:
        comparing.reference(after, before)
        console.print(f"{markup(first)} is now the reference, made from {markup(second)}.")
        return
    raise typer.Exit(0 if found.identical else 1)


def _named(source: str) -> str:
    return f"The configuration file {source}" if source.endswith(".toml") else f"The configuration '{source}'"


def _moved(before, after) -> str:
    return f"{before}" if before == after else f"{before} -> {after}"


@app.command()
def figures(run_: Run, trust: Trust = False) -> None:
    """Draw the figures of a finished run anew."""
    from . import curves
    from . import figures as drawn
    from . import tables as made

    with reading(run_):
        store = opened(run_, trust)
        curves.save(store, list(made.build(store)))
        if store.has("timings.parquet"):
            drawn.accuracy_speed(store)
    console.print(f"Figures are in {markup(run_ / 'figures')}.")


@app.command()
def report(run_: Run, trust: Trust = False) -> None:
    """Write report.html of a finished run anew: one file with everything, for any browser."""
    from .report import report as written

    with reading(run_):
        written(opened(run_, trust))
    console.print(f"The report is {markup(run_ / 'report.html')}.")


@app.command()
def explain(
    name: Annotated[Optional[str], typer.Argument(metavar="CASE", help="a case of the run, as in its tables and its report, like thin_wall/100/0007")] = None,
    run_: Annotated[Optional[Path], typer.Option("--run", help="folder of the run that has the case")] = None,
    file: Annotated[Optional[Path], typer.Option(help="a case in a file of its own, instead of a run")] = None,
    out: Annotated[Optional[Path], typer.Option(help="the page [default: CASE.html, with - for /]")] = None,
    save: Annotated[Optional[Path], typer.Option(help="also write the case into this file, for --file")] = None,
    ask: Annotated[bool, typer.Option("--ask", help="ask the methods anew, each in a process of its own")] = False,
    method: Annotated[Optional[list[str]], typer.Option("--method", help="which to ask with --ask; may be repeated [default: those of the run or file]")] = None,
    methods: Methods = None,
    trust: Trust = False,
) -> None:
    """Show one case: a page with its bodies in 3D and its certificate, and a table of what every method said."""
    from .report import explain as explained

    if (run_ is None) == (file is None) or (run_ is not None and name is None):
        raise configuration.ConfigError("Name a case and its run (ofg-bench explain thin_wall/100/0007 --run results/runs/quick), or a file (ofg-bench explain --file case.json).")
    _extend(methods, None)
    with reading(run_ or file):
        store = opened(run_, trust) if run_ else None
        explained.command(name, store, file, out, save, ask or bool(method), tuple(method or ()), tuple(map(str, methods or ())), trust,
                          _print_grid, console.print)


@app.command()
def verify(
    run_: Run,
    ask: Annotated[str, typer.Option(help="ask the methods again about this many random cases, or about all")] = "",
    ask_seed: Annotated[Optional[int], typer.Option(min=0, help="seed of that random choice")] = None,
    trust: Trust = False,
    workers: Workers = None,
) -> None:
    """Check a run: its files, its rows, every case drawn and proved again, and answers with --ask.

    Exit code 0 if nothing is refused, 1 if something is. experiments/truth/README.md says what this cannot find.
    """
    from . import verification

    if ask not in ("", "all") and not (ask.isascii() and ask.isdigit()):
        raise configuration.ConfigError(f"--ask takes a number of cases or the word all, not '{ask}'.")
    count = None if not ask else -1 if ask == "all" else int(ask)
    with reading(run_):
        found = verification.verify(Store(run_), count, trust, workers, ask_seed)
    for line in str(found).splitlines():
        console.print(given.printable(line), highlight=False, markup=False)
    raise typer.Exit(0 if found.ok else 1)


@app.command()
def check(name: Annotated[str, typer.Argument(metavar="METHOD", help='a method, with parameters if any: "ofg k=16"')], methods: Methods = None) -> None:
    """Put a method through the conformance suite that every method here must pass."""
    from baselines import conformance

    _extend(methods, None)
    failed = 0
    for method in registry.make(name):
        results = conformance.check(method)
        failed += sum(not ok for _, ok, _ in results)
        _print_grid(method.label, ("property", "", "detail"), [(n, "ok" if ok else "FAILED", detail) for n, ok, detail in results])
    raise typer.Exit(1 if failed else 0)


app.command()(native)


def _say_missing(config: configuration.RunConfig) -> None:
    from . import runner

    configuration.load_files(config)
    for reason in runner.missing(config.optional_methods):
        console.print(f"Its rows stay empty: {markup(reason)}", highlight=False)


def _print_table(table) -> None:
    """A table of a run, without its optional columns where the terminal is too narrow for them."""
    text, optional = table.text, list(table.optional)
    while optional and _width(text) > console.width:
        text = text.drop(columns=optional.pop(0))
    for columns in _strips(text):
        part = text[columns]
        _print_grid(table.title, part.columns, list(part.itertuples(index=False)), table.caption)


def _strips(text) -> list[list[str]]:
    """The columns in as many strips as it takes for each to fit the terminal; the first column is in all of them."""
    first, *rest = text.columns
    strips = [[first]]
    for column in rest:
        if len(strips[-1]) > 1 and _width(text[[*strips[-1], column]]) > console.width:
            strips.append([first])
        strips[-1].append(column)
    return strips


def _print_grid(title: str, columns, rows, caption: str = "") -> None:
    """Columns of numbers are aligned to the right. The first column is never folded."""
    console.print(f"[bold]{markup(title)}[/]", highlight=False)
    grid = Grid(box=None, pad_edge=False, header_style="bold")
    for i, column in enumerate(columns):
        grid.add_column(markup(column).strip(), justify="left" if any(str(row[i])[:1].isalpha() and row[i] != "all" for row in rows) else "right", no_wrap=i == 0, overflow="fold")
    for row in rows:
        grid.add_row(*map(markup, row))
    console.print(grid)
    console.print(markup(caption), style="dim", highlight=False)
    console.print()


def _width(text) -> int:
    return sum(max(len(str(v)) for v in (*text[c], c)) + 2 for c in text.columns)


def _levels(levels) -> str:
    shown = [f"{v:g}" for v in levels]
    return ", ".join(shown) if len(shown) < 9 else f"{shown[0]} .. {shown[-1]} ({len(shown)})"


def _extend(methods, scenario_files) -> None:
    for path in methods or ():
        registry.load_file(path)
    for path in scenario_files or ():
        scenarios.load_file(path)


def _failed(text: str, code: int, word: str = "Error") -> int:
    Console(stderr=True).print(f"[bold red]{word}.[/] {markup(text)}", highlight=False, soft_wrap=False)
    return code


def main() -> None:
    """Entry point: errors are one paragraph and no traceback; exit code 2 for the user's, 1 for the machine's."""
    try:
        app()
    except MachineError as error:
        sys.exit(_failed(str(error), 1, "Stopped"))
    except (ValueError, StoreError, BodyError, ImportError) as error:
        sys.exit(_failed(str(error), 2))
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        sys.exit(_failed(f"{where}{error.strerror or error}. Make it readable and writable, or free some space; what is finished "
                         "is kept: say the same command again.", 1 if error.errno in ERRNOS else 2))
    except KeyboardInterrupt:
        Console(stderr=True).print("\nInterrupted. What is finished is kept; say the same command again to go on.")
        sys.exit(130)


if __name__ == "__main__":
    main()
