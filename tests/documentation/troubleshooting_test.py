#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/troubleshooting.md explains messages that there are: each in its first columns is in the sources, word for word.

usage: troubleshooting_test.py SOURCE_DIR
"""
import re
import sys
from pathlib import Path

ROW = re.compile(r"^\| (`[^|]*)\|", re.M)
FOLDERS = ("armature", "drives", "robots", "idl")


def literals(source):
    """All sources, with texts in one piece that are written in several."""
    texts = (path.read_text() for folder in FOLDERS for path in sorted((source / folder).rglob("*.[ch]pp"))
             if "_test." not in path.name)
    return re.sub(r'"\s*"', "", "\n".join(texts))


def main():
    source = Path(sys.argv[1])
    said = literals(source)
    rows = ROW.findall((source / "docs" / "troubleshooting.md").read_text())
    messages = [message for row in rows for message in re.findall(r"`([^`]+)`", row)]
    unknown = [message for message in messages if message not in said]
    print("\n".join(f"troubleshooting.md: nothing says '{message}'" for message in unknown) or f"{len(messages)} messages")
    return 1 if unknown or len(messages) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
