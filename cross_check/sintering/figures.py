"""Draws the figures of the study as SVG and PDF."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from cross_check.report.figures import Figured, save
from cross_check.sintering import contact_figures, course_figures, law_figures, snapshots, strength_figures
from cross_check.sintering.judgement import SUITE
from cross_check.sintering.plots import Sheet
from cross_check.sintering.study import Failed, NotPlanned, Study

SCENE = f"{SUITE}/figures"
_GROUPS: dict[str, Callable[[Study], list[Sheet]]] = {
    "figures 3, 5 and 6": law_figures.figures,
    "figures 8 to 11": course_figures.figures,
    "figures 12 to 15": contact_figures.figures,
    "figures 16 to 19": strength_figures.figures,
    "figures 20 to 22": snapshots.figures,
}


def draw_all(study: Study, folder: Path, pdf: bool = True) -> tuple[list[Figured], list[str]]:
    """Draws all figures whose runs are there; returns them, and which are left out and why."""
    folder.mkdir(parents=True, exist_ok=True)
    drawn: list[Figured] = []
    left_out: list[str] = []
    for words, figures in _GROUPS.items():
        try:
            sheets = figures(study)
        except (NotPlanned, Failed) as error:
            left_out.append(f"{words}: no run of {error}" if isinstance(error, NotPlanned) else f"{words}: {error}")
            continue
        for sheet in sheets:
            svg = save(sheet.figure, folder / sheet.name, sheet.title, pdf)
            drawn.append(Figured(SCENE, sheet.title, sheet.name, svg, False, sheet.notes, pdf))
    return drawn, left_out
