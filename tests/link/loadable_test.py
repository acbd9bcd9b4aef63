#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every program and library of the build can be loaded: what is made read-only after relocation is there.

mold 1.10 lets that region begin with thread-local data, which takes no room. If such data are aligned to
less than what follows, the region may begin in a page of its own that nothing fills, depending on the
length of all that is before it; the loader then ends the program with "cannot apply additional memory
protection after relocation". So the first thread-local data of a file are aligned to 8 bytes at least, as what follows is.

usage: loadable_test.py BUILD_FOLDER
"""
import re
import subprocess
import sys
from pathlib import Path

LEAST = 8


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def alignment_of_thread_locals(path):
    """Of .tbss where it is the first of the thread-local data; None without."""
    sections = subprocess.run(["readelf", "-SW", path], capture_output=True, text=True, check=True).stdout
    found = re.search(r"\.(tdata|tbss) .* (\d+)$", sections, re.MULTILINE)
    return int(found.group(2)) if found and found.group(1) == "tbss" else None


def main():
    build = Path(sys.argv[1])
    files = [path for folder in ("bin", "lib", "tests") if (build / folder).exists()
             for path in (build / folder).rglob("*") if path.is_file() and not path.is_symlink() and is_elf(path)]
    if len(files) < 20:
        sys.exit(f"expected programs and libraries below {build}, found {len(files)}")
    wrong = [(path, alignment) for path in files
             if (alignment := alignment_of_thread_locals(path)) is not None and alignment < LEAST]
    for path, alignment in wrong:
        print(f"{path}: its thread-local data are aligned to {alignment}, expected {LEAST} at least: "
              "write alignas(8) before one of them")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
