"""The notebooks of the documentation run from the first cell to the last."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs" / "notebooks").glob("*.ipynb"))


def read(path: Path) -> Any:
    formats: Any = pytest.importorskip("nbformat", reason="nbformat is not installed; the extra `dev` brings it")
    return formats.read(path, as_version=4)


def test_there_are_notebooks() -> None:
    assert [path.name for path in NOTEBOOKS] == ["first_bed.ipynb"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_kept_without_results(path: Path) -> None:
    cells = [cell for cell in read(path).cells if cell.cell_type == "code"]
    assert cells
    assert [cell for cell in cells if cell.outputs or cell.execution_count] == []


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path, tmp_path: Path) -> None:
    client: Any = pytest.importorskip("nbclient", reason="nbclient is not installed; the extra `dev` brings it")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed; the extra `dev` brings it")
    notebook = read(path)
    # A cell that raises, an assertion among them, raises here with its traceback.
    client.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    kinds = {kind for output in outputs for kind in output.get("data", {})}
    assert {"image/png", "text/html"} <= kinds, "no figure or no table"
    assert [output for output in outputs if output.output_type == "stream" and output.name == "stderr"] == []
    assert list(tmp_path.iterdir()) == [], "the notebook leaves files behind"
