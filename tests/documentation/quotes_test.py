#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the pages quote is in the files as it is quoted.

usage: quotes_test.py SOURCE_DIR

A block of code below a line `<!-- from PATH -->` is there, word for word.
"""
import re
import sys
from pathlib import Path

QUOTE = re.compile(r"<!-- from (\S+) -->\n```\w+\n(.*?)```", re.S)

source = Path(sys.argv[1])
quotes = 0
mistakes = []
for page in sorted(source.glob("docs/**/*.md")):
    for path, code in QUOTE.findall(page.read_text()):
        quotes += 1
        if code not in (source / path).read_text():
            mistakes.append(f"{page.name}: this is not in {path}:\n{code}")
print("\n".join(mistakes) or f"{quotes} quotes")
sys.exit(1 if mistakes or quotes == 0 else 0)
