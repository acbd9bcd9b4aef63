#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/demo builds all that the tutorial installs and runs next.

usage: demo_builds_what_is_installed.py BUILD_DIR
"""

import glob
import os
import re
import subprocess
import sys


def main():
    build = os.path.realpath(sys.argv[1])
    answer = subprocess.run(["ninja", "-C", build, "-t", "query", "demo"], check=True,
                            capture_output=True, text=True).stdout
    built = {os.path.join(build, path.strip()) for path in answer.splitlines()}
    needed = set(glob.glob(os.path.join(build, "lib", "armature", "lib*.so")))
    for script in glob.glob(os.path.join(build, "**", "cmake_install.cmake"), recursive=True):
        with open(script, encoding="utf-8") as file:
            needed |= set(re.findall(r'"(%s/(?:bin|lib)/[^"]+)"' % re.escape(build), file.read()))
    # Of a library's three names, two are links that come with the third.
    names = {os.path.realpath(path) for path in needed if os.path.isfile(path)}
    missing = sorted(names - {os.path.realpath(path) for path in built})
    if len(names) < 8 or missing:
        sys.exit(f"scripts/demo does not build {missing} (of {len(names)} files)")
    print(f"scripts/demo builds all {len(names)} files that are installed or that examples load")


if __name__ == "__main__":
    main()
