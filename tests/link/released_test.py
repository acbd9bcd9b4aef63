#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""That no other library runs what `armature run` gives back of the libraries that it does not need.

  released_test.py SOURCE_DIR BUILD_DIR

The loader takes functions of the standard library from the first library that has them, so those
whose code is given back (armature/cli/release_code.cpp) must not offer any.
"""
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE, BUILD = map(Path, sys.argv[1:3])
OF_THE_STANDARD_LIBRARY = re.compile(r"(_ZNSt|_ZNKSt|_ZSt|_ZN9__gnu_cxx)")


def released():
    text = (SOURCE / "armature/cli/release_code.cpp").read_text(encoding="utf-8")
    lists = re.findall(r"string_view k(?:NeverRealTime|OfTools|OfTheTerminal|OfTheNetwork)\[\] = \{(.*?)\};", text, re.S)
    return [name for each in lists for name in re.findall(r'"(libarmature_\w+\.so)"', each)]


def offered(library):
    """Functions of the standard library that others may take from it."""
    table = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True)
    lines = (line.split() for line in table.stdout.splitlines())
    return [line[-1] for line in lines if line[-2] in "TW" and OF_THE_STANDARD_LIBRARY.match(line[-1])]


class Released(unittest.TestCase):
    def test_there_are_some(self):
        self.assertIn("libarmature_deploy.so", released())
        for name in ("inspect", "browser", "remote"):
            self.assertIn(f"libarmature_{name}.so", released())

    def test_they_offer_nothing_of_the_standard_library(self):
        for name in released():
            self.assertEqual(offered(BUILD / "lib" / name), [], f"{name}: call armature_not_in_every_run() in its CMakeLists.txt")

    def test_others_do(self):
        self.assertNotEqual(offered(BUILD / "lib/libarmature_exec.so"), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
