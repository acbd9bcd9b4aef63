#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles every C++ snippet of docs/authoring.md, and looks whether its list of units is complete.

usage: authoring_test.py SOURCE_DIR COMPILER OPTION...

The snippets of a section (a heading with two #) share a namespace. The first snippet stands behind
all others. Errors have the place in the page.
"""

import os
import re
import subprocess
import sys
import tempfile

LEAST_SNIPPETS = 10


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


def program(page, text):
    """The page's snippets as one source, and how many there are."""
    includes, body = [], []
    prelude, found = [], 0
    for section, line, code in snippets(text):
        found += 1
        includes += [each for each in code if each.startswith("#include")]
        code = ["" if each.startswith("#include") else each for each in code]
        if found == 1:
            prelude = [each for each in code if each]
            continue
        body += [f"namespace section_{section} {{", *prelude, f'#line {line} "{page}"', *code, "}"]
    return "\n".join(includes + body) + "\n", found


def missing_units(source, text):
    """Units that the program knows and the page does not list."""
    with open(os.path.join(source, "armature", "base", "unit.cpp"), encoding="utf-8") as file:
        table = re.search(r"kSymbols\[\] = \{\n(.*?)\n\};", file.read(), re.DOTALL).group(1)
    symbols = re.findall(r'^    \{"([^"]+)"', table, re.MULTILINE)
    section = text.split("\n## Units\n")[1].split("\n## ")[0]
    listed = set(re.findall(r"`([^`]+)`", section))
    if len(symbols) < 20:
        return ["(the table of units was not found)"]
    return [symbol for symbol in symbols if symbol not in listed]


def main():
    source = os.path.abspath(sys.argv[1])
    page = os.path.join(source, "docs", "authoring.md")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    unlisted = missing_units(source, text)
    if unlisted:
        sys.exit(f"{page}: error: these units are not listed: " + " ".join(unlisted))
    code, found = program(page, text)
    if found < LEAST_SNIPPETS:
        sys.exit(f"{page}: error: only {found} snippets were found")
    with tempfile.TemporaryDirectory() as work:
        path = os.path.join(work, "authoring.cpp")
        with open(path, "w", encoding="utf-8") as file:
            file.write(code)
        command = sys.argv[2:] + ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", path]
        done = subprocess.run(command, check=False)
    if done.returncode != 0:
        sys.exit(done.returncode)
    print(f"{found} snippets compile")


if __name__ == "__main__":
    main()
