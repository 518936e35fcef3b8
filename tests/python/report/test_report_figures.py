"""Claims about the figures: same bytes, no lost extreme, no lost NaN, labels as they are."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import synthetic_campaign
from synthetic_campaign import Written

from cross_check.report import figures, inline_svg
from cross_check.report.campaign import Campaign, Curve
from cross_check.report.palette import look
from cross_check.report.thinning import MOST_POINTS, thin


def few(**changes: object) -> Campaign:
    """A campaign with two figures, few enough to be drawn in this process."""
    campaign = synthetic_campaign.build(1, points=600)
    return replace(campaign, curves=campaign.curves[:1], **changes)  # pyright: ignore[reportArgumentType]


def test_same_campaign_gives_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        figures.draw_all(few(), tmp_path / name)
    files = sorted(path.name for path in (tmp_path / "one").iterdir())
    assert {Path(name).suffix for name in files} == {".svg", ".pdf"}
    for name in files:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_other_processes_draw_the_same(odd: Written, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    campaign = odd.campaign
    assert len(campaign.curves) + len(campaign.sweeps) <= figures.FEW
    monkeypatch.setattr(figures, "FEW", 0)
    for item in figures.draw_all(campaign, tmp_path):
        assert item.svg in odd.page
        for name in (f"{item.name}.svg", f"{item.name}.pdf"):
            assert (tmp_path / name).read_bytes() == (odd.folder / "report" / "figures" / name).read_bytes()


def test_thinning_keeps_extremes_and_ends() -> None:
    x = np.linspace(0.0, 1.0, 50_001)
    y = np.sin(40 * x)
    y[12_345], y[23_456] = 7.0, -9.0
    drawn = thin(Curve("native", x, y))
    assert len(drawn.x) <= MOST_POINTS
    assert {7.0, -9.0, y[0], y[-1]} <= set(drawn.y)
    assert drawn.peak == 9.0


def test_nan_is_counted_and_breaks_the_line() -> None:
    x = np.linspace(0.0, 1.0, 5000)
    y = np.linspace(0.0, 1.0, 5000)
    y[100] = np.nan
    y[200] = np.inf
    drawn = thin(Curve("yade", x, y))
    assert len(drawn.x) <= MOST_POINTS
    assert np.isnan(drawn.y).sum() == 2
    assert drawn.note == "yade: 2 of 5000 values are not finite numbers (NaN)"


def test_nan_in_a_curve_is_noted_under_the_figure(tmp_path: Path) -> None:
    campaign = few(sweeps=[])
    broken = replace(campaign.curves[0], curves=[Curve("yade", np.arange(3.0), np.array([0.0, np.nan, 1.0]))])
    (drawn,) = figures.draw_all(replace(campaign, curves=[broken]), tmp_path)
    assert drawn.notes == ["yade: 1 of 3 values are not finite numbers (NaN)"]


@pytest.mark.parametrize("values", [np.zeros(0), np.full(4, np.nan), np.zeros(4)])
def test_empty_and_equal_curves_are_drawn(tmp_path: Path, values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> None:
    curve = Curve("native", np.arange(float(len(values))), values)
    campaign = few(sweeps=[])
    bare = replace(campaign.curves[0], curves=[curve], residuals=[replace(curve, source="native - reference")])
    assert figures.draw_all(replace(campaign, curves=[bare]), tmp_path)[0].svg.endswith("</svg>")


def test_curve_of_unequal_columns_is_refused() -> None:
    with pytest.raises(ValueError, match="curve lammps: x has shape"):
        thin(Curve("lammps", np.zeros(3), np.zeros(4)))


def test_slim_svg_rounds_outlines_but_not_labels() -> None:
    text = '<text style="font: 8px \'DejaVu Sans\'" x="1.23456">0.00567</text>'
    raw = f'<svg viewBox="0 0 9 9"><g id="text_1">{text}</g></svg>'
    slim = inline_svg.slim(raw, "name", "a <title>")
    assert ">0.00567<" in slim
    assert 'x="1.23"' in slim
    assert 'aria-label="a &lt;title&gt;"' in slim


def test_labels_of_others_are_escaped_in_figures(tmp_path: Path) -> None:
    campaign = few(sweeps=[])
    curve = replace(campaign.curves[0].curves[0], source="<script>$x_1$")
    (drawn,) = figures.draw_all(
        replace(campaign, curves=[replace(campaign.curves[0], curves=[curve], title="<b>")]), tmp_path
    )
    assert "&lt;script&gt;$x_1$" in drawn.svg
    assert "<script" not in drawn.svg


def test_mirror_has_the_hue_of_its_code_and_another_dash() -> None:
    for code in synthetic_campaign.CODES:
        assert look(f"native[{code}]").color == look(code).color == look(f"{code} - native[{code}]").color
        assert look(f"native[{code}]").dash != look(code).dash
    assert len({look(name).color for name in ("native", "reference", *synthetic_campaign.CODES)}) == 5
