"""Fixtures of the tests of the Python module."""

import json
import os
import subprocess

import pytest


@pytest.fixture
def carlo():
    """Runs carlo of the same build and returns its standard output. Exit code 1 is a result, not a failure."""

    def run(*arguments):
        result = subprocess.run([os.environ["CARLO"], *arguments], capture_output=True, text=True, timeout=120)
        assert result.returncode in (0, 1), result.stderr
        return result.stdout

    return run


@pytest.fixture
def carlo_json(carlo, tmp_path):
    """Runs carlo with --json and returns the parsed file."""

    def run(*arguments):
        path = tmp_path / "result.json"
        carlo(*arguments, "--json", str(path))
        return json.loads(path.read_text())

    return run
