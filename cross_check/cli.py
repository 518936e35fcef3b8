"""The command `cross-check`."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import click
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from cross_check import bench, campaign, doctor, export, recording, runs, suites
from cross_check.adapters import ADAPTERS
from cross_check.adapters.interface import InvalidScene, NotComparable, RunFailed
from cross_check.baseline import BaselineError
from cross_check.compare.expectations import ExpectationError
from cross_check.compare.quantity import UnknownQuantity
from cross_check.compare.verdicts import Comparison
from cross_check.engine import CaseError, load_case
from cross_check.meshes import MeshError
from cross_check.record import RecordError, read
from cross_check.sintering import command as sintering
from cross_check.sintering.errors import StudyError

AS_EXPECTED, UNEXPECTED, BAD_INPUT = 0, 1, 2


def _fail(message: object) -> NoReturn:
    click.echo(f"error: {message}", err=True)
    sys.exit(BAD_INPUT)


@contextmanager
def _refusing() -> Generator[None]:
    """Turns every foreseen error into one line and the exit code of bad input."""
    try:
        yield
    except (
        CaseError,
        RecordError,
        export.ExportError,
        MeshError,
        UnknownQuantity,
        ExpectationError,
        InvalidScene,
        BaselineError,
        bench.BenchError,
        RunFailed,
        StudyError,
        OSError,
    ) as error:
        _fail(error)


@click.group()
@click.version_option(package_name="crossgrain")
def main() -> None:
    """States a DEM case once, runs it in several codes, and says where they differ and why."""


@main.command("list")
def list_() -> None:
    """Lists suites and cases."""
    with _refusing():
        cases = suites.every_case()
    table = [
        {
            "case": case.name,
            "level": case.level,
            "suites": case.suites,
            "variants": len(case.variants),
            "question": case.question,
        }
        for case in cases
    ]
    if not sys.stdout.isatty():
        click.echo(json.dumps({"suites": suites.SUITES, "cases": table}, indent=1))
        return
    for case in cases:
        click.echo(f"{case.name:22} {case.level}  {len(case.variants):3} variants  {', '.join(case.suites)}")
        click.echo(f"{'':22} {case.question}")


@main.command("doctor")
def doctor_() -> None:
    """Tells which codes and parts are present, what is missing and how to get it."""
    found = doctor.examine()
    if not sys.stdout.isatty():
        click.echo(json.dumps([part.to_dict() for part in found], indent=1))
        return
    for part in found:
        click.echo(f"{'ok     ' if part.present else 'missing'} {part.name:12} {part.version}")
        if part.advice:
            click.echo(f"{'':21}{part.advice}")


@main.command("deck")
@click.argument("case")
@click.option("--code", type=click.Choice(list(ADAPTERS)), required=True, help="Code to write the deck for.")
@click.option("--out", type=click.Path(path_type=Path), required=True, help="Folder of the deck.")
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Replaces a value of the case.")
def deck_(case: str, code: str, out: Path, overrides: tuple[str, ...]) -> None:
    """Writes the input deck of CASE (a name or a file) and translation.json, one folder per variant."""
    with _refusing():
        _, cases = suites.select(case)
        if overrides:
            cases = [load_case(item.path, list(overrides)) for item in cases]
        written, reasons = 0, list[str]()
        for variant in (variant for item in cases for variant in item.variants):
            scene = variant.scenes[0]
            try:
                deck = ADAPTERS[code].deck(scene)
            except NotComparable as reason:
                reasons.append(f"{scene.name}: not-comparable({reason})")
                continue
            campaign.write_deck(deck, out / variant.member)
            written += 1
    for reason in reasons:
        click.echo(reason, err=True)
    if written == 0:
        _fail(f"{code} has no form for {case}")
    click.echo(f"{written} {'deck' if written == 1 else 'decks'} in {out}")


@main.command("run")
@click.argument("what", metavar="CASE|SUITE")
@click.option("--codes", default=",".join(ADAPTERS), show_default=True, help="Codes to run, joined by commas.")
@click.option("--jobs", type=click.IntRange(min=1), default=None, help="Runs at a time; the number of cores if absent.")
@click.option("--full", is_flag=True, help="Runs the variants that the quick form of a suite leaves out, too.")
@click.option("--seeds", type=click.IntRange(min=1), default=None, help="Seeds of every ensemble; all if absent.")
@click.option("--live", is_flag=True, help="Makes every run now: neither the cache nor recorded runs are used.")
@click.option("--any-version", is_flag=True, help="Runs versions for which the translation is not proved, too.")
@click.option("--expected", type=click.Path(path_type=Path), default=None, help="Expected verdicts of own cases.")
@click.option("--time-limit", type=float, default=300.0, show_default=True, help="Seconds per deck.")
@click.option(
    "--figures/--no-figures",
    default=True,
    help="Draws the figures of the report; `cross-check report` draws them later.",
)
@click.option("--out", type=click.Path(path_type=Path), default=Path("out"), show_default=True, help="Output folder.")
def run_(
    what: str,
    codes: str,
    jobs: int | None,
    full: bool,
    seeds: int | None,
    live: bool,
    any_version: bool,
    expected: Path | None,
    time_limit: float,
    figures: bool,
    out: Path,
) -> None:
    """Runs a case or a suite natively and in every code, compares, and reports."""
    chosen = tuple(code.strip() for code in codes.split(",") if code.strip())
    unknown = [code for code in chosen if code not in ADAPTERS]
    if unknown:
        _fail(f"--codes {codes}: no such code {', '.join(unknown)} (known: {', '.join(ADAPTERS)})")
    options = runs.Options(codes=chosen, live=live, full=full, any_version=any_version, time_limit=time_limit)
    if jobs is not None:
        options = replace(options, jobs=jobs)
    if what == suites.STUDY:
        study = sintering.Options(full, seeds, options.jobs, live, figures, expected)
        with _refusing():
            result = sintering.run(study, out, _progress)
        for line in result.lines:
            click.echo(line)
        _leave(result.verdicts, result.page)
    with _refusing():
        suite, cases = suites.select(what)
        if seeds is not None:
            cases = [suites.with_seeds(case, seeds) for case in cases]
        suites.require_gates(cases)
        out.mkdir(parents=True, exist_ok=True)
        with (
            _progress(runs.count(cases, options)) as progress,
            tempfile.TemporaryDirectory(prefix="crossgrain-") as work,
        ):
            finished = campaign.run(suite, cases, options, Path(work), progress)
        campaign.keep(finished, out)
        _conclude(finished, out, expected, figures=figures)


@main.command("compare")
@click.argument("folders", nargs=-1, required=True, type=click.Path(path_type=Path))
def compare_(folders: tuple[Path, ...]) -> None:
    """Compares the records of kept campaigns anew and writes their reports, with figures as SVG and PDF."""
    with _refusing():
        for folder in folders:
            finished = campaign.load(folder)
            if folder == folders[-1]:
                _conclude(finished, folder, pdf=True)
            else:
                campaign.write(finished, folder)


@main.command("report")
@click.argument("folder", type=click.Path(path_type=Path))
def report_(folder: Path) -> None:
    """Writes the report of a kept campaign anew, its figures as SVG and PDF."""
    with _refusing():
        page, _ = campaign.write(campaign.load(folder), folder)
    click.echo(page)


@main.command("export")
@click.argument("record", type=click.Path(path_type=Path))
@click.option("--to", required=True, metavar="|".join(export.FORMATS), help="Format of the files.")
@click.option(
    "--out", type=click.Path(path_type=Path), default=Path("export"), show_default=True, help="Output folder."
)
@click.option("--case", default=None, help="Name or file of the record's case; tells materials, domain and walls.")
@click.option("--set", "overrides", multiple=True, metavar="KEY=VALUE", help="Replaces a value of the case.")
@click.option("--contacts", is_flag=True, help="Refuses a record without contacts.")
def export_(record: Path, to: str, out: Path, case: str | None, overrides: tuple[str, ...], contacts: bool) -> None:
    """Converts the record folder RECORD for ParaView (pvd), OVITO (dump), pandas (csv) or mesh tools (vtu)."""
    with _refusing():
        if case is None and overrides:
            raise export.ExportError(f"--set {overrides[0]}: there is no --case whose value could be replaced")
        stated = None
        if case is not None:
            _, found = suites.select(case)
            if len(found) != 1:
                raise export.ExportError(f"--case {case}: holds {len(found)} cases, the record is of one")
            stated = load_case(found[0].path, list(overrides)) if overrides else found[0]
        written = export.write(read(record), to, out, case=stated, contacts=contacts)
    for path in written:
        click.echo(path)


@main.command("record")
@click.argument("what", metavar="CASE|SUITE", default="standard")
def record_(what: str) -> None:
    """Refreshes reference/recorded/ from the installed codes, as a diff to review."""
    with _refusing():
        _, cases = suites.select(what)
        with _progress(runs.count(cases, runs.Options())) as progress:
            stored, removed = recording.refresh(cases, progress)
    click.echo(f"{stored} records stored, {removed} of other decks removed")


@main.command("bench")
@click.option("--out", type=click.Path(path_type=Path), default=Path("out"), show_default=True, help="Output folder.")
@click.option("--particles", type=click.IntRange(min=1), default=32_000, show_default=True, help="Size of the bed.")
@click.option("--steps", type=click.IntRange(min=1), default=300, show_default=True, help="Steps; YADE makes a tenth.")
@click.option("--repeats", type=click.IntRange(min=1), default=3, show_default=True, help="Turns of every code.")
def bench_(out: Path, particles: int, steps: int, repeats: int) -> None:
    """Times the native engine and the installed codes in turns on the jammed bed; writes DIR/bench.json."""
    options = bench.Options(particles, steps, repeats)
    with _refusing(), _progress(repeats * (1 + len(bench.CONTESTANTS))) as progress:
        entries = bench.run(options, out, progress)
    for line in bench.table(entries):
        click.echo(line)


@contextmanager
def _progress(total: int) -> Generator[runs.Progress]:
    """A bar on a terminal, one JSON line per tenth of the runs elsewhere."""
    if sys.stderr.isatty():
        columns = (TextColumn("{task.description:18}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
        with Progress(*columns, console=Console(stderr=True)) as bar:
            task = bar.add_task("runs", total=total)
            yield lambda source, done: bar.update(task, advance=done, description=source)
        return
    finished = 0

    def tell(source: str, done: int) -> None:
        nonlocal finished
        before, finished = finished, finished + done
        if before * 10 // max(total, 1) != finished * 10 // max(total, 1):
            click.echo(json.dumps({"source": source, "runs": finished, "of": total}), err=True)

    yield tell


def _conclude(
    finished: campaign.Finished, out: Path, expected: Path | None = None, pdf: bool = False, figures: bool = True
) -> NoReturn:
    """Reports, and leaves with the exit code of the contract."""
    page, verdicts = campaign.write(finished, out, expected, pdf, figures)
    if not verdicts:
        _fail(f"nothing was compared: the cases state no gate for the sources {', '.join(('native', *finished.codes))}")
    for line in campaign.rates(finished):
        click.echo(line)
    _leave(verdicts, page)


def _leave(verdicts: list[Comparison], page: Path) -> NoReturn:
    """Names what is not as expected, says the result in one line, and leaves with the exit code of the contract."""
    wrong = campaign.unexpected(verdicts)
    for item in wrong:
        click.echo(
            f"{item.case}: {item.quantity}, {item.left.source} vs {item.right.source}: "
            f"{item.verdict}, expected {item.expected}",
            err=True,
        )
    click.echo(f"{len(verdicts)} comparisons, {len(wrong)} not as expected; report: {page}")
    sys.exit(UNEXPECTED if wrong else AS_EXPECTED)
