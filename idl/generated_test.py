#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Generated C++ is laid out plainly, and compiles without warnings.

usage: generated_test.py RCIDL COMPILER SOURCE_DIR

Looks at what is generated from testdata, and from interfaces with names and numbers of parameters by
chance, from fixed seeds. Of the latter some are compiled; tests/idl compiles what is in testdata.
"""
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SEEDS = 12
COMPILED = 2
COLUMNS = 100
TYPES = ["int", "float", "double", "String", "Array<double>", "Array<double, 3>", "unsigned long",
         "bool", "Array<bool>", "Array<String>", "struct Abc", "Array<struct LongerName>", "enum Way",
         "Array<enum Way, 2>"]
NUMBERS = TYPES[:3]
LETTERS = "abcdefghijklmnopqrstuvwxyz"
FLAGS = ["-std=c++20", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Wpedantic", "-Werror"]
LITERAL = re.compile(r'"(\\.|[^"\\])*"')


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
        return f"{limits}{kind} p{number}{self.word(40)}"

    def enumerator(self, number):
        return f"e{number}{self.word(22).lower()}{self.maybe(0.3, f' = {number}')}"

    def operation(self, number):
        result = self.random.choice(TYPES + ["void"] * 5)
        parameters = [self.parameter(i) for i in range(self.random.randint(0, 9))]
        return f"  {result} o{number}{self.word(50)}({', '.join(parameters)});"

    def file(self):
        lines = ["struct Abc { int q; [unit(\"m\"), range(0, 1)] double zz; };",
                 "struct LongerName { struct Abc abcd; };", "enum Way { to, fro };",
                 f"enum Many {{ {', '.join(self.enumerator(i) for i in range(256))} }};"]
        for i in range(4):
            lines.append(f"/// {self.text(40)}")
            lines.append(f"{self.random.choice(['struct', 'event'])} S{i}{self.word(40)} {{")
            lines += [self.member(j) for j in range(self.random.randint(1, 12))] + ["};"]
        for i in range(3):
            lines.append(f"interface I{i}{self.word(40)} {{")
            lines += [self.operation(j) for j in range(30)] + ["};"]
        return "\n".join(lines) + "\n"


def is_one_token(line):
    """A name, type or literal with the punctuation around it: no rule divides it."""
    words = LITERAL.sub('""', line.strip())
    return " " not in words.removeprefix("/// ").removeprefix("const ")


def mistakes_in(path):
    """Every line that breaks a rule; the last one's indentation says how deep the next may be."""
    depth = 0
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        indent = len(line) - len(line.lstrip())
        place = f"{path.name}:{number}: "
        if "\t" in line or line != line.rstrip():
            yield place + "a tab, or blanks at the end"
        if len(line) > COLUMNS and not is_one_token(line):
            yield f"{place}{len(line)} columns: {line}"
        label = re.fullmatch(r" (public|protected|private):", line)
        if line and not label and (indent % 2 != 0 or indent > depth + 4):
            yield f"{place}{indent} columns of indentation after {depth}"
        depth = indent if line else depth


def compile_alone(compiler, source, folder, name):
    unit = folder / f"{name}.cpp"
    unit.write_text(f'#include "{name}_client.cpp"\n#include "{name}_service.cpp"\n')
    subprocess.run([compiler, *FLAGS, "-fsyntax-only", f"-I{source}", f"-I{folder}", unit], check=True)


def main():
    rcidl, compiler, source = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work, "out")
        files = sorted((source / "idl/testdata").glob("*.idl"))
        for seed in range(SEEDS):
            files.append(Path(work) / f"chance{seed}.idl")
            files[-1].write_text(Chance(seed).file())
        for file in files:
            subprocess.run([rcidl, file, "--out", folder], check=True)
        generated = sorted(folder.glob("*.?pp"))
        assert len(generated) == 5 * len(files), generated
        mistakes = [mistake for path in generated for mistake in mistakes_in(path)]
        assert not mistakes, "\n".join(mistakes)
        for seed in range(COMPILED):
            compile_alone(compiler, source, folder, f"chance{seed}")


if __name__ == "__main__":
    main()
