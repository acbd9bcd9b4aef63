#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/command_line.md has each command as the programs themselves explain it.

usage: command_line_test.py SOURCE_DIR FOLDER_OF_PROGRAMS [--write]

A block below a line `<!-- help of COMMAND -->` is what `COMMAND --help` prints, and no command is left out.
--write puts it there.
"""
import re
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"(<!-- help of ([^\n]+) -->\n```\n)(.*?)(```\n)", re.S)
COMMANDS = re.compile(r"^Subcommands:\n((?:  .*\n)+)", re.M)


def help_of(command, programs):
    program, *words = command.split()
    done = subprocess.run([programs / program, *words, "--help"], capture_output=True, text=True, check=True)
    return done.stdout.strip("\n") + "\n"


def commands_below(command, programs):
    """With those below them."""
    for listed in COMMANDS.findall(help_of(command, programs)):
        for line in listed.splitlines():
            if re.match(r"  \S", line):
                below = f"{command} {line.split()[0]}"
                yield below
                yield from commands_below(below, programs)


def main():
    source, programs = Path(sys.argv[1]), Path(sys.argv[2])
    page = source / "docs" / "command_line.md"
    text = page.read_text()
    if "--write" in sys.argv:
        page.write_text(BLOCK.sub(lambda block: block[1] + help_of(block[2], programs) + block[4], text))
        return 0
    shown = {command: body for _, command, body, _ in BLOCK.findall(text)}
    mistakes = [f"{page.name}: `{command} --help` prints:\n{help_of(command, programs)}"
                for command, body in shown.items() if body != help_of(command, programs)]
    wanted = [command for program in ("armature", "rcidl") for command in commands_below(program, programs)]
    mistakes += [f"{page.name}: '{command}' is missing" for command in wanted + ["rcidl"] if command not in shown]
    print("\n".join(mistakes) or f"{len(shown)} commands")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
