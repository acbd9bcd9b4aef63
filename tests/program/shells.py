# SPDX-License-Identifier: Apache-2.0
"""Types at an interactive shell, as a person does, and tells what Tab has made of each line.

usage: shells.py SHELL PREPARATION LINE... [-- PREFIX...]

SHELL is bash, zsh or fish, the latter with what HOME has for it; PREPARATION is its first command; PREFIX begins another process in which
it runs, such as `chroot FOLDER`. Each line is printed as it was after Tab.
"""
import os
import pty
import re
import select
import sys

COMMANDS = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"], "fish": ["fish", "--private", "-i"]}
# Split words: what is typed is not what is waited for.
PROMPT = {"bash": """PS1=rea''dy'> '""", "zsh": """PS1=rea''dy'> '""",
          "fish": """function fish_prompt; echo -n rea''dy'> '; end"""}
TO_BEGIN = "\x01"  # Ctrl-A
PATIENCE = 60


class Shell:
    def __init__(self, shell, prefix=(), environment=None):
        command = [*prefix, *COMMANDS[shell]]
        child, self.terminal = pty.fork()
        if child == 0:
            os.execvpe(command[0], command, {**os.environ, **(environment or {}), "TERM": "xterm"})
        self.process = child
        self.shown = ""
        self.type(PROMPT[shell] + "\n")
        self.wait_for("ready> ")

    def type(self, text):
        os.write(self.terminal, text.encode())

    def wait_for(self, pattern):
        """What matches the pattern in what is shown from now on."""
        while not (found := re.search(pattern, self.shown)):
            if not select.select([self.terminal], [], [], PATIENCE)[0]:
                raise TimeoutError(f"no {pattern!r} within {PATIENCE} s, but {self.shown[-400:]!r}")
            self.shown += os.read(self.terminal, 4096).decode(errors="replace")
        self.shown = self.shown[found.end():]
        return found

    def run(self, command):
        self.type(command + "\n")
        self.wait_for("ready> ")

    def completed(self, line):
        """The line after Tab, with a space if one was added: the shell itself says it, since echo and quotes are put around it.
        What is typed first is a letter: before others, and before it moves, zsh takes back a space that it has added."""
        self.type(f"{line}\ti'E''ND{TO_BEGIN}echo BE''GIN'\n")
        said = self.wait_for("BEGIN(.*?)iEND")[1]
        self.wait_for("ready> ")
        return said

    def close(self):
        os.close(self.terminal)
        os.waitpid(self.process, 0)


def completed(shell, preparation, lines, **where):
    """Each of the lines as Tab has made it, in a shell whose first command is the preparation."""
    typed_at = Shell(shell, **where)
    try:
        typed_at.run(preparation)
        return [typed_at.completed(line) for line in lines]
    finally:
        typed_at.close()


def main():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    shell, preparation, *lines = words[:at]
    print("\n".join(completed(shell, preparation, lines, prefix=words[at + 1:])))


if __name__ == "__main__":
    main()
