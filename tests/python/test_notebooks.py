"""The notebooks run, and are committed with their outputs."""

import pathlib
import re

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[2] / "notebooks-data").glob("*.ipynb"))


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def words_of(cell):
    """The text that a cell prints, without its numbers, which depend on the machine."""
    text = "".join(output.get("text", "") for output in cell.outputs)
    return re.sub(r"[-+]?\d[\d.]*(e[-+]?\d+)?|\s+|0x\w+", " ", text).split()


def test_there_are_three():
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebook_runs(path, tmp_path, monkeypatch):
    monkeypatch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    committed = nbformat.read(path, as_version=4)
    again = nbformat.read(path, as_version=4)
    # A cell that raises ends the run with its traceback.
    ExecutePreprocessor(timeout=120, kernel_name="python3").preprocess(again, {"metadata": {"path": str(tmp_path)}})
    for before, after in zip(code_cells(committed), code_cells(again)):
        kinds = [sorted({o.output_type for o in cell.outputs}) for cell in (before, after)]
        assert kinds[0] == kinds[1] and words_of(before) == words_of(after), (
            "run jupyter nbconvert --execute --inplace, and commit the result"
        )
    assert any("image/png" in o.get("data", {}) for cell in code_cells(again) for o in cell.outputs)
    assert path.stat().st_size < 300_000
