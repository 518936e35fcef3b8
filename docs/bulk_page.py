"""Writes docs/bulk.md from the verdicts of a campaign of beds: python docs/bulk_page.py out/bulk."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

HEAD = """# Beds in every code

Written by `docs/bulk_page.py` from the verdicts of `{command}` of {started}. Means of ensembles with their standard
errors; margins were fixed beforehand. `inconclusive` means that the seeds do not decide.

{environment}

"""
CHECKS = {
    "equivalence": "means",
    "equivalence_curve": "curves",
    "matched": "matched",
    "at_most": "every seed at most",
    "at_least": "every seed at least",
    "horizon": "horizon",
}


def _value(side: dict[str, Any]) -> str:
    if side["value"] is None:
        return "-"
    error = side["uncertainty"]
    return f"{side['value']:.5g}" + ("" if not error else f" ± {error:.1g}")


def _row(item: dict[str, Any]) -> str:
    found = "-" if item["discrepancy"] is None else f"{item['discrepancy']:.2g}"
    verdict = item["verdict"].partition("(")[0]
    cells = [
        item["quantity"].replace("_", " "),
        CHECKS[item["check"]],
        f"{item['left']['source']}: {_value(item['left'])}",
        f"{item['right']['source']}: {_value(item['right'])}",
        found,
        f"{item['bound']:g}",
        verdict if verdict == "agree" else f"**{verdict}**",
    ]
    return f"| {' | '.join(cells)} |"


def _reason(item: dict[str, Any]) -> str:
    source = item["left" if item["right"]["source"] == "bound" else "right"]["source"]
    return f"- {item['case']}, {source}: {item['verdict']}"


def page(folder: Path, command: str) -> str:
    """The page of a kept campaign."""
    index = json.loads((folder / "campaign.json").read_text())
    verdicts = [item for item in json.loads((folder / "verdicts.json").read_text()) if item["check"] in CHECKS]
    left_out = [item for item in verdicts if item["verdict"].startswith(("not-run", "not-comparable"))]
    shown = [item for item in verdicts if item not in left_out]
    codes = ", ".join(["native", *index["codes"]])
    text = HEAD.format(
        command=command,
        started=index["started"][:10],
        environment=f"Sources: {codes}.",
    )
    for case in dict.fromkeys(item["case"] for item in shown):
        rows = [_row(item) for item in shown if item["case"] == case]
        text += f"## {case}\n\n| observable | check | left | right | difference | bound | verdict |\n"
        text += "|---|---|---|---|---|---|---|\n" + "\n".join(rows) + "\n\n"
    reasons = dict.fromkeys(_reason(item) for item in left_out if item["verdict"] != "not-run(full only)")
    if reasons:
        text += "## What was not compared\n\n" + "\n".join(reasons) + "\n"
    return text.rstrip() + "\n"


if __name__ == "__main__":
    Path(__file__).with_name("bulk.md").write_text(page(Path(sys.argv[1]), " ".join(sys.argv[2:])))
