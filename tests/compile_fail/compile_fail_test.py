#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles FILE, which must fail with the text after each of its lines `// expect: `.

A file without such a line must compile. usage: compile_fail_test.py FILE COMPILER OPTION...
"""

import re
import subprocess
import sys


def main():
    file, compiler = sys.argv[1:3]
    command = [compiler] + sys.argv[3:] + ["-std=c++20", "-fsyntax-only", file]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    with open(file, encoding="utf-8") as source:
        expected = re.findall(r"^// expect: (.+)$", source.read(), re.MULTILINE)
    if not expected:
        sys.exit(done.stderr if done.returncode != 0 else 0)
    if done.returncode == 0:
        sys.exit(f"{file}: it compiles, but must not")
    refusals = re.findall(r"error: static (?:_?assert\w*) failed.*", done.stderr)
    # In Clang's words, and in GCC's.
    refusals += re.findall(r"error: .* (?:is a private member of|is inaccessible within) .*", done.stderr)
    for text in expected:
        if not any(text in refusal for refusal in refusals):
            sys.exit(f"{file}: no error says '{text}':\n" + done.stderr)
    if len(refusals) != len(expected):
        sys.exit(f"{file}: more than its own mistake is refused:\n" + done.stderr)


if __name__ == "__main__":
    main()
