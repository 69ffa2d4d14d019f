#!/usr/bin/env python3
"""Writes the contracts of the C++ headers as a table of docstrings, so that both languages have one text.

Usage: docstrings.py OUTPUT.h HEADER...
A contract is the block of `///` comments before a class, struct or function.
"""

import re
import sys

CLASS = re.compile(r"^(?:template.*>\s*)?(?:requires.*\s)?(?:class|struct)\s+(\w+)\s*(?:final\s*)?\{")
FUNCTION = re.compile(r"^(?:template.*>\s*)?(?:inline\s+)?[\w:<>*&, ]+?[ *&](\w+)\(")


def contracts(text):
    """Yields (name, comment) for every documented class and function at the outermost level."""
    comment = []
    lines = iter(text.splitlines())
    for line in lines:
        if line.startswith("/// @"):
            comment = []
        elif line.startswith("///"):
            comment.append(line[4:] if line.startswith("/// ") else line[3:])
        elif comment:
            declaration = line
            while not re.search(r"[{;]", declaration) and line and not line.startswith("///"):
                line = next(lines, "")
                declaration += " " + line.strip()
            match = CLASS.match(declaration) or FUNCTION.match(declaration)
            if match:
                yield match.group(1), "\n".join(comment).rstrip()
            comment = []


def main(output, headers):
    docs = {}
    for header in headers:
        with open(header, encoding="utf-8") as file:
            for name, comment in contracts(file.read()):
                docs.setdefault(name, comment)
    with open(output, "w", encoding="utf-8") as file:
        file.write("// Written by docstrings.py.\nconstexpr Contract contracts[] = {\n")
        for name in sorted(docs):
            file.write(f'    {{"{name}", R"contract({docs[name]})contract"}},\n')
        file.write("};\n")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
