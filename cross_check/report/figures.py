"""Draws the figures of a campaign: vector files for papers and a slim form for the page."""

# pyright: reportUnknownMemberType=false
# matplotlib leaves the keywords of its methods untyped.

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from functools import cache, partial
from io import StringIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from cross_check.report import drawing, inline_svg, notation
from cross_check.report.campaign import Campaign, Curve, CurveSet, SweepPlot, case_of
from cross_check.report.drawing import Job
from cross_check.report.palette import rank
from cross_check.report.thinning import MOST_DIFFERENCES, thin

STYLE = Path(__file__).with_name("style.mplstyle")
WORKERS = 2
FEW = 20  # up to here starting workers takes longer than drawing


@dataclass(frozen=True)
class Figured:
    """A figure that has been drawn: `svg` is its inline form, `notes` say what the drawing cannot show.

    `figures/NAME.svg` and, where `pdf`, `figures/NAME.pdf` lie beside the page.
    """

    scene: str
    title: str
    name: str
    svg: str
    sweep: bool
    notes: list[str]
    pdf: bool


Drawing = Callable[[], Figured]
"""Draws one figure and writes its files; another process can be given it."""


def draw_all(campaign: Campaign, folder: Path, pdf: bool = True, others: Sequence[Drawing] = ()) -> list[Figured]:
    """Draws every curve set and sweep into `folder` as svg and, if asked, pdf, and then `others`.

    They are drawn in two processes where that pays.
    """
    folder.mkdir(parents=True, exist_ok=True)

    def drawings() -> Iterator[Drawing]:
        yield from (partial(draw, job) for job in _jobs(campaign, folder, pdf))
        yield from others

    if len(campaign.curves) + len(campaign.sweeps) + len(others) > FEW:
        context = multiprocessing.get_context("spawn")
        try:
            with ProcessPoolExecutor(WORKERS, mp_context=context) as pool:
                return list(pool.map(_drawn, drawings(), chunksize=2))
        except BrokenProcessPool:
            pass  # no second process to be had here (an interactive session, a small container): draw in this one
    return [_drawn(one) for one in drawings()]


def _drawn(one: Drawing) -> Figured:
    return one()


def _jobs(campaign: Campaign, folder: Path, pdf: bool) -> Iterator[Job]:
    """The figures one by one, so that the first are drawn while the last are still thinned."""
    taken: set[str] = set()

    def stem(item: CurveSet | SweepPlot) -> Path:
        base = name = notation.slug(f"{item.case} {item.title}")
        count = 1
        while name in taken:
            count += 1
            name = f"{base}-{count}"
        taken.add(name)
        return folder / name

    for sweep in campaign.sweeps:
        yield _sweep_job(sweep, stem(sweep), pdf)
    for curves in campaign.curves:
        yield _curves_job(curves, stem(curves), pdf)


def _ordered(curves: list[Curve]) -> list[Curve]:
    return sorted(curves, key=lambda curve: rank(curve.source))


def _curves_job(item: CurveSet, stem: Path, pdf: bool) -> Job:
    return Job(
        stem,
        item.case,
        item.title,
        f"{item.x_label} [{item.x_unit}]",
        f"{item.y_label} [{item.y_unit}]",
        item.residual_label,
        [thin(curve) for curve in _ordered(item.curves)],
        [thin(curve, scale=item.residual_scale, absolute=True, limit=MOST_DIFFERENCES) for curve in item.residuals],
        sweep=False,
        pdf=pdf,
    )


def _sweep_job(item: SweepPlot, stem: Path, pdf: bool) -> Job:
    return Job(
        stem,
        case_of(item.case),
        item.title,
        item.x_label,
        item.y_label,
        "|difference|",
        [thin(curve) for curve in _ordered(item.points)],
        [thin(curve, absolute=True, limit=MOST_DIFFERENCES) for curve in item.residuals],
        sweep=True,
        pdf=pdf,
    )


@cache
def _style() -> Any:  # the type of its keys changes with the version of matplotlib
    return dict(mpl.rc_params_from_file(STYLE, use_default_template=False))


def save(lay_out: Callable[[], Figure], stem: Path, title: str, pdf: bool) -> str:
    """Lays a figure out in the style of the report and writes its files; returns the form that stands in the page."""
    with mpl.rc_context(_style()):
        figure = lay_out()
        text = StringIO()
        blank = {"Date": None, "Creator": None, "Format": None, "Type": None}
        figure.savefig(text, format="svg", metadata=blank)
        if pdf:
            blank = {"CreationDate": None, "Creator": None, "Producer": None}
            figure.savefig(f"{stem}.pdf", format="pdf", metadata=blank)
    svg = text.getvalue()
    Path(f"{stem}.svg").write_text(svg, encoding="utf-8")
    return inline_svg.slim(svg, stem.name, title)


def draw(job: Job) -> Figured:
    """Draws one figure and writes its files; the same job gives the same bytes."""
    svg = save(lambda: drawing.figure(job), job.stem, job.title, job.pdf)
    notes = [drawn.note for drawn in (*job.curves, *job.residuals) if drawn.note]
    return Figured(job.scene, job.title, job.stem.name, svg, job.sweep, notes, job.pdf)
