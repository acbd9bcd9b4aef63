#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails if docs/rules.md or a page of a robot names a test that does not exist.

usage: rules_test.py SOURCE_DIR
"""

import glob
import os
import re
import sys

LEAST_RULES = 30


def existing_tests(source):
    names = set()
    for folder, _, files in os.walk(source):
        if os.sep + "build" in folder[len(source):]:
            continue
        for file in files:
            if not file.endswith("_test.cpp"):
                continue
            with open(os.path.join(folder, file), encoding="utf-8") as text:
                for found in re.finditer(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", text.read(),
                                         re.MULTILINE):
                    names.add(".".join(found.groups()))
    return names


def check(page, known):
    """How many tests the page names, and an error for each that does not exist."""
    named = 0
    missing = []
    with open(page, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            for test in re.findall(r"`(\w+\.[A-Z]\w+)`", line):
                if test == "Suite.Test":
                    continue
                named += 1
                if test not in known:
                    missing.append(f"{page}:{number}: error: there is no test {test}")
    return named, missing


def main():
    source = os.path.abspath(sys.argv[1])
    known = existing_tests(source)
    rules = os.path.join(source, "docs", "rules.md")
    named, missing = check(rules, known)
    if named < LEAST_RULES:
        missing.append(f"{rules}: error: only {named} tests are named")
    for page in sorted(glob.glob(os.path.join(source, "robots", "*", "*.md"))):
        missing += check(page, known)[1]
    sys.exit("\n".join(missing) if missing else 0)


if __name__ == "__main__":
    main()
