#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails if a page of rules in docs/, or a page of a robot, names a test that does not exist.

usage: rules_test.py SOURCE_DIR
"""

import glob
import os
import re
import sys

LEAST_RULES = {"docs/can.md": 15, "docs/promises.md": 40, "docs/ride.md": 20, "docs/rules.md": 30, "docs/robot.md": 15,
               "docs/security.md": 15}


def existing_tests(source):
    names = set()
    for folder, _, files in os.walk(source):
        if os.sep + "build" in folder[len(source):]:
            continue
        for file in files:
            if not file.endswith(("_test.cpp", "_test.py")):
                continue
            with open(os.path.join(folder, file), encoding="utf-8") as opened:
                text = opened.read()
            if file.endswith(".py"):
                names.update(re.findall(r"^    def (test_\w+)\(self", text, re.MULTILINE))
                names.update("test_" + row for row in re.findall(r'^    Attack\("(\w+)"', text, re.MULTILINE))
                continue
            for found in re.finditer(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text, re.MULTILINE):
                names.add(".".join(found.groups()))
            for found in re.finditer(r"\bBreakage\{\s*\"(\w+)\"", text):  # of the campaign
                names.add("Campaign/" + found[1])
    return names


def mistakes_of(page, least, known):
    """What is wrong on a page, a line each."""
    named = 0
    with open(page, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            for test in re.findall(r"`(\w+[./][A-Z]\w+|test_\w+)`", line):
                if test == "Suite.Test":
                    continue
                named += 1
                if test not in known:
                    yield f"{page}:{number}: error: there is no test {test}"
    if named < least:
        yield f"{page}: error: only {named} tests are named"


def main():
    source = os.path.abspath(sys.argv[1])
    known = existing_tests(source)
    pages = {os.path.join(source, page): least for page, least in LEAST_RULES.items()}
    pages.update({page: 0 for page in glob.glob(os.path.join(source, "robots", "*", "*.md"))})
    mistakes = [mistake for page, least in sorted(pages.items())
                for mistake in mistakes_of(page, least, known)]
    sys.exit("\n".join(mistakes) if mistakes else 0)


if __name__ == "__main__":
    main()
