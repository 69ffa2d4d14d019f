"""The package: documentation, names, and carlo."""

import ast
import pathlib
import subprocess
import sys

import libmc

MODULES = [libmc, libmc.warps, libmc.samplers, libmc.points, libmc.mis]


def public(thing):
    return [(n, v) for n, v in vars(thing).items() if not n.startswith("_") and not hasattr(v, "__path__")]


def test_everything_public_is_documented():
    for module in MODULES:
        assert module.__doc__
        for name, value in public(module):
            assert value.__doc__, f"{module.__name__}.{name}"
            if isinstance(value, type) and value.__module__.startswith("libmc"):
                for member, what in public(value):
                    assert what.__doc__, f"{module.__name__}.{name}.{member}"


def test_names_are_those_of_the_package():
    assert libmc.Integral.__module__ == "libmc"
    assert libmc.warps.Tent.__module__ == "libmc.warps"
    assert set(libmc.__all__) <= set(dir(libmc))


def test_carlo_runs_as_a_module():
    result = subprocess.run([sys.executable, "-m", "libmc", "--version"], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert libmc.__version__ in result.stdout


def test_every_page_of_help_renders():
    for module in MODULES:
        subprocess.run([sys.executable, "-m", "pydoc", module.__name__], check=True, capture_output=True)


def test_stubs_have_every_public_name():
    for module in MODULES:
        file = pathlib.Path(module.__file__).with_suffix(".pyi")
        tree = ast.parse(file.read_text())
        names = {n.name for n in tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        assert names >= {n for n, v in public(module) if callable(v)}
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef) and issubclass(getattr(module, node.name), libmc.warps.Warp):
                assert node.name == "Warp" or any(getattr(m, "name", "") == "__init__" for m in node.body)
