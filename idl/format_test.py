#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generated C++ is formatted: clang-format leaves it as it is.

usage: format_test.py RCIDL CLANG_FORMAT SOURCE_DIR

Looks at what is generated from testdata, and from interfaces with names and numbers of parameters by
chance, from fixed seeds.
"""
import random
import subprocess
import sys
import tempfile
from pathlib import Path

SEEDS = 12
TYPES = ["int", "float", "double", "String", "Array<double>", "Array<double, 3>", "unsigned long",
         "bool", "Array<bool>", "Array<String>", "struct Abc", "Array<struct LongerName>"]
NUMBERS = TYPES[:3]
LETTERS = "abcdefghijklmnopqrstuvwxyz"


class Chance:
    """Makes an interface definition from a seed."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def word(self, longest):
        length = self.random.randint(1, longest)
        return "".join(self.random.choice(LETTERS + "XYZ") for _ in range(length))

    def text(self, words):
        return " ".join(self.word(12) for _ in range(self.random.randint(1, words)))

    def maybe(self, probability, text):
        return text if self.random.random() < probability else ""

    def member(self, number):
        unit = self.maybe(0.3, '[unit("rad/s")] ')
        limits = self.maybe(0.2, "[range(-1, 2000)] ")
        kind = self.random.choice(NUMBERS if unit or limits else TYPES)
        doc = self.maybe(0.5, f"  ///< {self.text(25)}")
        return f"  {unit}{limits}{kind} m{number}{self.word(22)};{doc}"

    def parameter(self, number):
        kind = self.random.choice(TYPES)
        limits = self.maybe(0.3, "[range(0, 12)] ") if kind in NUMBERS else ""
        return f"{limits}{kind} p{number}{self.word(22)}"

    def operation(self, number):
        result = self.random.choice(TYPES + ["void"] * 5)
        parameters = [self.parameter(i) for i in range(self.random.randint(0, 9))]
        return f"  {result} o{number}{self.word(28)}({', '.join(parameters)});"

    def file(self):
        lines = ["struct Abc { int q; [unit(\"m\"), range(0, 1)] double zz; };",
                 "struct LongerName { struct Abc abcd; };"]
        for i in range(4):
            lines.append(f"/// {self.text(40)}")
            lines.append(f"{self.random.choice(['struct', 'event'])} S{i}{self.word(20)} {{")
            lines += [self.member(j) for j in range(self.random.randint(1, 12))] + ["};"]
        for i in range(3):
            lines.append(f"interface I{i}{self.word(20)} {{")
            lines += [self.operation(j) for j in range(30)] + ["};"]
        return "\n".join(lines) + "\n"


def main():
    rcidl, clang_format, source = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as work:
        files = sorted((source / "idl/testdata").glob("*.idl"))
        for seed in range(SEEDS):
            files.append(Path(work) / f"chance{seed}.idl")
            files[-1].write_text(Chance(seed).file())
        for file in files:
            subprocess.run([rcidl, file, "--out", f"{work}/out"], check=True)
        generated = sorted(str(path) for path in Path(work, "out").glob("*.?pp"))
        assert len(generated) == 5 * len(files), generated
        done = subprocess.run([clang_format, f"--style=file:{source}/.clang-format", "--dry-run",
                               "--Werror", *generated], check=False)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
