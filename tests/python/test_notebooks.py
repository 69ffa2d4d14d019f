"""The notebooks run, and are committed with their outputs."""

import pathlib

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "notebooks-data").glob("*.ipynb"))


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def test_there_are_three():
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebook_runs(path, tmp_path, monkeypatch):
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    committed = nbformat.read(path, as_version=4)
    again = nbformat.read(path, as_version=4)
    # A cell that raises ends the run with its traceback.
    ExecutePreprocessor(timeout=120, kernel_name="python3").preprocess(again, {"metadata": {"path": str(tmp_path)}})
    kinds = [[sorted({o.output_type for o in cell.outputs}) for cell in code_cells(n)] for n in (committed, again)]
    assert kinds[0] == kinds[1], "run jupyter nbconvert --execute --inplace, and commit the result"
    assert any("image/png" in o.get("data", {}) for cell in code_cells(again) for o in cell.outputs)
    assert path.stat().st_size < 300_000
