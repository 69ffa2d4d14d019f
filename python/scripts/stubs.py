#!/usr/bin/env python3
"""Writes the type stubs of libmc from the signatures of the extension.

Usage: PYTHONPATH=FOLDER stubs.py OUTPUT_FOLDER
"""

import inspect
import os
import re
import sys

import libmc
import libmc._libmc

HEAD = """# Written by stubs.py.
import os
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

import libmc
"""


def plain(text, module):
    """A signature of pybind11 as Python writes it."""
    text = text.replace(f"libmc._libmc{module}.", "").replace("libmc._libmc.", "libmc.")
    text = re.sub(r"numpy\.ndarray\[([\w.]+)\]", r"NDArray[\1]", text)
    text = re.sub(r"NDArray\[bool\]", "NDArray[numpy.bool_]", text)
    text = re.sub(r"List\[(\w+)\[\d+\]\]", r"Sequence[\1]", text)
    text = re.sub(r"(?<=: )List\[", "Sequence[", text)
    text = re.sub(r"\b(handle)\b", "Any", text)
    text = re.sub(r"-> object$", "-> Any", text)
    text = re.sub(r": function\b", ": Callable[..., Any]", text)
    text = re.sub(r": ([\w.]+)( = None)", r": Optional[\1]\2", text).replace("Optional[object]", "Any")
    return re.sub(r"= <[^>]*>", "= ...", text)


def signatures(name, doc, module):
    """The signatures of a function: one, or all of an overloaded one."""
    found = re.findall(rf"^(?:\d+\. )?({re.escape(name)}\((?!\*args, \*\*kwargs\)$).*\) -> .*)$", doc or "", re.MULTILINE)
    return [plain(one, module) for one in found]


def write_function(name, function, module, indent, out, static=False):
    found = signatures(name, function.__doc__, module)
    for one in found:
        if len(found) > 1:
            out.append(f"{indent}@overload")
        if static:
            out.append(f"{indent}@staticmethod")
        one = re.sub(r"^(\w+)\(self: [^,)]+", r"\1(self", one)
        out.append(f"{indent}def {one}: ...")


def write_class(name, cls, module, out):
    bases = [b.__name__ for b in cls.__bases__ if b.__module__.startswith("libmc") or b is ValueError]
    bases = ["libmc." + b if b == "Error" and module else b for b in bases]
    out.append(f"class {name}({', '.join(bases)}):" if bases else f"class {name}:")
    before = len(out)
    for member, value in sorted(vars(cls).items()):
        if isinstance(value, property):
            match = re.search(r"-> (.*)$", value.fget.__doc__ or "", re.MULTILINE)
            out.append("    @property")
            out.append(f"    def {member}(self) -> {plain(match.group(1), module) if match else 'Any'}: ...")
        elif isinstance(value, staticmethod):
            write_function(member, value.__func__, module, "    ", out, static=True)
        elif inspect.isroutine(value) and member not in ("__new__", "__getstate__", "__setstate__", "_pybind11_conduit_v1_"):
            write_function(member, value, module, "    ", out)
    if cls.__name__ == "NotFiniteError":
        out += ["    u: NDArray[numpy.float64]", "    bad: int", "    points: int"]
    if len(out) == before:
        out.append("    ...")


def stub(extension, module):
    out = []
    classes = {n: v for n, v in vars(extension).items() if isinstance(v, type)}
    for name, cls in sorted(classes.items(), key=lambda item: len(item[1].__mro__)):
        out.append("")
        write_class(name, cls, module, out)
    for name, value in sorted(vars(extension).items()):
        if inspect.isroutine(value):
            out.append("")
            write_function(name, value, module, "", out)
    text = "\n".join(out) + "\n"
    return HEAD + ("from typing import overload\n" if "@overload" in text else "") + text


def main(folder):
    for name in libmc._submodules:
        extension = getattr(libmc._libmc, name)
        with open(os.path.join(folder, f"{name}.pyi"), "w", encoding="utf-8") as file:
            file.write(stub(extension, "." + name))
    with open(os.path.join(folder, "__init__.pyi"), "w", encoding="utf-8") as file:
        file.write(stub(libmc._libmc, ""))
        names = ", ".join(f"{name} as {name}" for name in libmc._submodules)
        file.write(f"\nfrom . import {names}\n\n__version__: str\n")
        file.write(f"\ndef assert_distribution{inspect.signature(libmc.assert_distribution)} -> Report: ...\n")


if __name__ == "__main__":
    main(sys.argv[1])
