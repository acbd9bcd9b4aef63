#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of docs/tutorial.md and docs/own_robot.md, in order, in one shell each block.

usage: tutorial_test.py SOURCE_DIR BUILD_DIR

Blocks that begin with ```sh must succeed, those with ```sh fails must not; ```sh setup is what the
build that runs this test has done already.
"""

import os
import re
import subprocess
import sys
import tempfile

SECONDS_FOR_A_BLOCK = 600


def blocks(text):
    """(line, kind, commands) of each shell block."""
    for found in re.finditer(r"^```sh ?(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, found.start()) + 1, found.group(1), found.group(2)


PAGES = {"tutorial.md": 8, "own_robot.md": 3}  # and at least so many blocks


def follow(source, build, name, least):
    page = os.path.join(source, "docs", name)
    environment = dict(os.environ)
    environment["PATH"] = os.path.join(build, "bin") + os.pathsep + environment["PATH"]
    run = 0
    with open(page, encoding="utf-8") as file, tempfile.TemporaryDirectory() as work:
        # A fresh clone, as far as the commands look at it.
        os.symlink(os.path.join(source, "examples"), os.path.join(work, "examples"))
        os.mkdir(os.path.join(work, "build"))
        os.symlink(build, os.path.join(work, "build", "program"))
        for line, kind, commands in blocks(file.read()):
            if kind == "setup":
                continue
            status = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=work,
                                    env=environment, timeout=SECONDS_FOR_A_BLOCK).returncode
            if (status != 0) != (kind == "fails"):
                sys.exit(f"{page}:{line}: error: exit status {status} of:\n{commands}")
            run += 1
    if run < least:
        sys.exit(f"{page}: error: only {run} blocks of commands were found")
    print(f"{run} blocks of commands did what {name} says")


def main():
    source, build = map(os.path.abspath, sys.argv[1:3])
    for name, least in PAGES.items():
        follow(source, build, name, least)


if __name__ == "__main__":
    main()
