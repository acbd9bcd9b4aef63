#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes pages of the manual by help2man: of each program, and of each command of `armature`.

usage: manual.py FOLDER PACKAGE=PROGRAM ...    FOLDER/PACKAGE/PROGRAM.1.gz
"""
import gzip
import pathlib
import re
import subprocess
import sys


def said_by(*words: str) -> str:
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def summary(help_text: str) -> str:
    """The first sentence, which may be broken into lines."""
    paragraph = help_text.split("\nUsage:")[0].replace("\n", " ")
    return re.split(r"\.( |$)", paragraph)[0].strip()


def commands(help_text: str) -> list[str]:
    listed = help_text.split("\nSubcommands:\n")[1]
    return re.findall(r"^  (\S+)", listed, re.MULTILINE)


def write_page(folder: pathlib.Path, words: list[str]) -> None:
    name = "-".join([pathlib.Path(words[0]).name, *words[1:]])
    version = said_by(words[0], "--version").split()[1]
    page = said_by("help2man", "--no-info", f"--version-string={version}",
                   f"--name={summary(said_by(*words, '--help'))}", " ".join(words))
    page = re.sub(r'^\.TH \S+', f".TH {name.upper()}", page, count=1, flags=re.MULTILINE)
    page = page.replace(f"{pathlib.Path(words[0]).name} {' '.join(words[1:])} \\- ", f"{name} \\- ", 1)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.1.gz").write_bytes(gzip.compress(page.encode(), mtime=0))


def main() -> None:
    for each in sys.argv[2:]:
        package, program = each.split("=", 1)
        folder = pathlib.Path(sys.argv[1]) / package
        write_page(folder, [program])
        if pathlib.Path(program).name != "armature":
            continue
        for command in commands(said_by(program, "--help")):
            write_page(folder, [program, command])


main()
