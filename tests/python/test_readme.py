"""The examples of the READMEs run as they stand."""

import os
import pathlib
import re

import pytest

import libmc

ROOT = pathlib.Path(__file__).parents[2]


@pytest.mark.parametrize("readme", ["README.md", "python/README.md"])
def test_examples_run(readme, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / readme).read_text(), re.DOTALL)
    assert blocks
    names = {"libmc": libmc}
    for block in blocks:
        exec(compile(block, readme, "exec"), names)
    for name, value in list(names.items()):
        if name.startswith("test_"):
            value()
    assert os.listdir(tmp_path) or readme == "README.md"
