#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the pages link to is there, headings included, and the index of docs/ leads to every page of it.

usage: links_test.py SOURCE_DIR
"""
import re
import sys
from pathlib import Path

LINK = re.compile(r'\]\(([^)\s]+)(?: "[^"]*")?\)')
FENCE = re.compile(r"^```.*?^```", re.M | re.S)
HEADING = re.compile(r"^#+ (.+)$", re.M)
ELSEWHERE = ("http://", "https://", "mailto:")


def anchors(text):
    """Of its headings, as GitHub makes them."""
    for heading in HEADING.findall(FENCE.sub("", text)):
        yield re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower()).replace(" ", "-")


def broken_links(source, page):
    for link in LINK.findall(FENCE.sub("", page.read_text())):
        if link.startswith(ELSEWHERE):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{page.relative_to(source)}: unknown target '{link}'"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text()):
            yield f"{page.relative_to(source)}: '{target.name}' has no heading for '#{anchor}'"


def main():
    source = Path(sys.argv[1]).resolve()
    pages = [page for folder in ("", "docs", "examples", "robots", "benchmarks", "web")
             for page in sorted((source / folder).glob("**/*.md" if folder else "*.md"))
             if "node_modules" not in page.parts]
    mistakes = [mistake for page in pages for mistake in broken_links(source, page)]
    index = (source / "docs" / "README.md").read_text()
    ours = [str(page.relative_to(source / "docs")) for page in sorted((source / "docs").glob("**/*.md"))]
    mistakes += [f"docs/README.md does not lead to '{page}'" for page in ours
                 if page != "README.md" and f"]({page})" not in index]
    print("\n".join(mistakes) or f"{len(pages)} pages")
    return 1 if mistakes or len(pages) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
