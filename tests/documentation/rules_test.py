#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails if a page of rules in docs/, or a page of a robot, names a test that does not exist, or not in its file.

usage: rules_test.py SOURCE_DIR [--write]

A link to a file of tests, or of a suite that several files instantiate, has the tests in its title: [port_test](../armature/component/ports/port_test.cpp "Port.IsRead, Port.IsWritten").
Tests that stand elsewhere, in backquotes, have to exist as well. --write mends links to files that have moved.
"""

import os
import re
import sys
from pathlib import Path

LEAST_RULES = {"docs/bundle.md": 5, "docs/can.md": 15, "docs/canopen.md": 10, "docs/editing.md": 5, "docs/foxglove.md": 5, "docs/generate.md": 5, "docs/packages.md": 4,
               "docs/papers.md": 400, "docs/promises.md": 40, "docs/replay.md": 40, "docs/ride.md": 20, "docs/rules.md": 30, "docs/robot.md": 15, "docs/ros2.md": 10,
               "docs/security.md": 15}
QUOTES_PORTS = {"foxglove.md"}  # which look like tests
NAME = r"\w+[./][A-Z]\w+|test_\w+"
LINK = re.compile(r'\[(\w+_(?:test|conformance))\]\(([^)\s]+?\.(?:cpp|hpp|py))(?: "([^"]*)")?\)')
QUOTED = re.compile(f"`({NAME})`")
CPP_TEST = re.compile(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", re.MULTILINE)
BREAKAGE = re.compile(r'\bBreakage\{\s*"(\w+)"')  # of the campaign
PYTHON_TEST = re.compile(r"^    def (test_\w+)\(self", re.MULTILINE)
ATTACK = re.compile(r'^    Attack\("(\w+)"', re.MULTILINE)


def tests_in(file):
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".py":
        return set(PYTHON_TEST.findall(text)) | {"test_" + attack for attack in ATTACK.findall(text)}
    return {".".join(found) for found in CPP_TEST.findall(text)} | {"Campaign/" + row for row in BREAKAGE.findall(text)}


def existing_tests(source):
    """{test: [files that have it]}"""
    known = {}
    for folder, below, files in os.walk(source):
        below[:] = [each for each in below if each not in ("build", ".git", "node_modules")]
        for file in files:
            if file.endswith(("_test.cpp", "_test.py", "_conformance.hpp")):
                for test in tests_in(Path(folder, file)):
                    known.setdefault(test, []).append(Path(folder, file))
    return known


def mistakes_of_link(page, link, known):
    file = (page.parent / link[2]).resolve()
    if link[1] != file.stem:
        yield f"a link says {link[1]} and leads to {file.name}"
    if not link[3]:
        yield f"the link to {file.name} names no test in its title"
    for test in filter(None, (link[3] or "").split(", ")):
        files = known.get(test, [])
        if not files:
            yield f"unknown test {test}"
        elif file not in files:
            yield f"{test} is in {os.path.relpath(files[0], page.parent)}, not in {link[2]}; --write mends that"


def mistakes_of(page, least, known):
    """What is wrong on a page, a line each."""
    named = 0
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        found = [mistake for link in LINK.finditer(line) for mistake in mistakes_of_link(page, link, known)]
        quoted = [] if page.name in QUOTES_PORTS else QUOTED.findall(LINK.sub("", line))
        found += [f"unknown test {test}" for test in quoted if test not in known]
        named += len(quoted) + sum(len((link[3] or "").split(", ")) for link in LINK.finditer(line))
        yield from (f"{page}:{number}: error: {mistake}" for mistake in found)
    if named < least:
        yield f"{page}: error: only {named} tests are named"


def mended(page, link, known):
    """The link with its tests where they are now: one link for each file."""
    files = {}
    for test in (link[3] or "").split(", "):
        here = (page.parent / link[2]).resolve()
        found = known.get(test, [here])
        files.setdefault(here if here in found else found[0], []).append(test)
    return ", ".join(f'[{file.stem}]({os.path.relpath(file, page.parent)} "{", ".join(tests)}")'
                     for file, tests in files.items())


def main():
    source = Path(sys.argv[1]).resolve()
    known = existing_tests(source)
    pages = {page: 0 for page in source.glob("robots/*/*.md")}
    pages.update({source / page: least for page, least in LEAST_RULES.items()})
    if "--write" in sys.argv:
        for page in pages:
            text = page.read_text(encoding="utf-8")
            page.write_text(LINK.sub(lambda link: mended(page, link, known), text), encoding="utf-8")
    mistakes = [mistake for page, least in sorted(pages.items()) for mistake in mistakes_of(page, least, known)]
    sys.exit("\n".join(mistakes) if mistakes else 0)


if __name__ == "__main__":
    main()
