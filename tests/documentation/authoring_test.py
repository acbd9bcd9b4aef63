#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles every C++ snippet of docs/authoring.md and its parts, and looks whether the list of units is complete.

usage: authoring_test.py SOURCE_DIR COMPILER OPTION...

The snippets of a section (a heading with two #) share a namespace. The first snippet of docs/authoring.md stands before
all others. Errors have the place in the page.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

LEAST_SNIPPETS = 16
LEAST_UNITS = 20


def snippets(text):
    """(section, line, code) of each C++ block; all of them must be plain ```cpp."""
    section = 0
    begun = None
    for number, line in enumerate(text.splitlines(), 1):
        if begun is not None:
            if line.startswith("```"):
                yield section, begun + 1, lines
                begun = None
            else:
                lines.append(line)
        elif line == "```cpp":
            begun, lines = number, []
        elif line.startswith("## "):
            section += 1


def program(pages):
    """The snippets of all pages as one source, and how many they are."""
    found = [(page, *snippet) for page in pages for snippet in snippets(page.read_text(encoding="utf-8"))]
    includes = [line for *_, code in found for line in code if line.startswith("#include")]
    prelude = [line for line in found[0][3] if line and not line.startswith("#include")]
    body = []
    for page, section, line, code in found[1:]:
        code = ["" if each.startswith("#include") else each for each in code]
        body += [f"namespace {page.stem}_{section} {{", *prelude, f'#line {line} "{page}"', *code, "}"]
    return "\n".join(includes + body) + "\n", len(found)


def missing_units(source, page):
    """Units that the program knows and the page leaves out."""
    table = re.search(r"kSymbols\[\] = \{\n(.*?)\n\};", (source / "armature/base/unit.cpp").read_text(encoding="utf-8"),
                      re.DOTALL)
    symbols = re.findall(r'^    \{"([^"]+)"', table.group(1) if table else "", re.MULTILINE)
    if len(symbols) < LEAST_UNITS:
        return ["(the table of units in armature/base/unit.cpp was not found)"]
    section = page.read_text(encoding="utf-8").split("\n## Units\n")[1].split("\n## ")[0]
    listed = set(re.findall(r"`([^`]+)`", section))
    return [symbol for symbol in symbols if symbol not in listed]


def main():
    source = Path(sys.argv[1]).resolve()
    first, parts = source / "docs/authoring.md", source / "docs/authoring"
    unlisted = missing_units(source, parts / "properties.md")
    if unlisted:
        sys.exit(f"{parts / 'properties.md'}: error: these units are not listed: " + " ".join(unlisted))
    code, found = program([first, *sorted(parts.glob("*.md"))])
    if found < LEAST_SNIPPETS:
        sys.exit(f"{parts}: error: only {found} snippets were found")
    with tempfile.TemporaryDirectory() as work:
        path = Path(work, "authoring.cpp")
        path.write_text(code, encoding="utf-8")
        command = sys.argv[2:] + ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", str(path)]
        done = subprocess.run(command, check=False)
    if done.returncode != 0:
        sys.exit(done.returncode)
    print(f"{found} snippets compile")


if __name__ == "__main__":
    main()
