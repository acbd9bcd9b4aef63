#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generates C++ from the interface definitions in docs/idl.md and compiles its C++ against that.

usage: documentation_test.py RCIDL SOURCE_DIR COMPILER OPTION...

A definition begins with its file's name in a comment. All C++ of the page is one source.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def main():
    rcidl, source, compile_command = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    page = (source / "docs/idl.md").read_text(encoding="utf-8")
    definitions, snippets = blocks(page, "idl"), blocks(page, "cpp")
    assert len(definitions) >= 2 and len(snippets) >= 2, (definitions, snippets)
    with tempfile.TemporaryDirectory() as work:
        names = []
        for definition in definitions:
            names.append(re.match(r"// (\w+\.idl)\n", definition)[1])
            Path(work, names[-1]).write_text(definition, encoding="utf-8")
        for name in names:
            subprocess.run([rcidl, f"{work}/{name}", "--out", f"{work}/generated"], check=True)
        Path(work, "page.cpp").write_text("\n".join(snippets), encoding="utf-8")
        sources = [f"{work}/page.cpp", *map(str, sorted(Path(work, "generated").glob("*.cpp")))]
        for each in sources:
            subprocess.run([*compile_command, "-std=c++20", "-Wall", "-Wextra", "-Wconversion",
                            "-Wshadow", "-Wpedantic", "-Werror", "-fsyntax-only", f"-I{work}/generated",
                            f"-I{source}", each], check=True)


if __name__ == "__main__":
    main()
