#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function whose documentation has a line `@rt` has a test under the real-time guard.

usage: check_coverage.py SOURCE_DIR [--list]

Reads the public headers of armature/ and drives/ and looks for the name of each such function, in quotes, in
the C++ files of tests/realtime/, where expect_realtime("Latest::write", ...) bears it. A function
outside a class is named with its namespace, "types::same_shape"; of a class template BasicX, X
counts. A line `@rt` above a class is about the class: "FixedText".
"""
import re
import sys
from pathlib import Path

CLASS = re.compile(r"^( *)(?:template <.*> )?(?:class|struct) (?:\[\[.*?\]\] )?(\w+)[^;]*$")
DOC = re.compile(r"^ *///")
SKIPPED = re.compile(r"^ *(template <.*>|\[\[.*\]\]|#.*|)$")
FUNCTION = re.compile(r"(operator\(\)|~?\w+)\(")


def realtime_functions(header, library):
    """(line, name) of everything in the header that says it is real-time."""
    classes = []  # (indentation, name) of those that are open
    promised = None  # the line of an @rt whose declaration is yet to come
    for number, line in enumerate(header.splitlines(), start=1):
        while classes and line.startswith(" " * classes[-1][0] + "};"):
            classes.pop()
        if DOC.match(line):
            if re.match(r"^ *///.*@rt\b", line):
                promised = number
            continue
        if SKIPPED.match(line):
            continue
        declared = CLASS.match(line)
        if promised:
            yield promised, name_of(line, declared, classes, library)
            promised = None
        if declared:
            classes.append((len(declared[1]), plain(declared[2])))


def name_of(line, declared, classes, library):
    if declared:
        return plain(declared[2])
    function = FUNCTION.search(line)
    owner = classes[-1][1] if classes else library
    return f"{owner}::{function[1] if function else line.strip()}"


def plain(class_name):
    return re.sub(r"^Basic(?=[A-Z])", "", class_name)


def public_headers(source_dir):
    for folder in ("armature", "drives"):
        for path in sorted((source_dir / folder).rglob("*.hpp")):
            parts = path.relative_to(source_dir).parts
            if "internal" not in parts and parts[1] != "testing":
                yield path, parts[1]


def check(source_dir):
    """(place, name, whether it is tested) for every real-time function."""
    tests = "\n".join(p.read_text() for p in sorted((source_dir / "tests/realtime").glob("*.cpp")))
    for path, library in public_headers(source_dir):
        for line, name in realtime_functions(path.read_text(), library):
            yield f"{path.relative_to(source_dir)}:{line}", name, f'"{name}"' in tests


def main():
    found = list(check(Path(sys.argv[1])))
    if "--list" in sys.argv:
        print("\n".join(f"{place}: {name}" for place, name, _ in found))
        return 0
    missing = [(place, name) for place, name, tested in found if not tested]
    for place, name in missing:
        print(f"{place}: error: no test in tests/realtime/ names \"{name}\"; add one that calls it "
              f"by expect_realtime", file=sys.stderr)
    if not found:
        print(f"error: no header below {sys.argv[1]} says @rt", file=sys.stderr)
    return 1 if missing or not found else 0


if __name__ == "__main__":
    sys.exit(main())
