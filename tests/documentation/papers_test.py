#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/papers.md says of each statement of the papers whether it is so here, and names what shows it.

usage: papers_test.py SOURCE_DIR FOLDER_OF_PROGRAMS

Tests and files that it names exist, deployments pass `armature check`, the totals are those of its rows. That each of these
mistakes is found is shown on copies of the page that have it.
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import links_test
import rules_test

SOURCE, PROGRAMS = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
PAGE = "docs/papers.md"
LEAST_ROWS = 350
VERDICTS = ("as written", "differs: ", "not built: ")
LINK = re.compile(r"\[[^\]]+\]\(([^)\s]+)")
DEPLOYMENT = re.compile(r"\.(yaml|xml)$")
PAPER = re.compile(r"^## Paper (\d)$")
TOTALS = re.compile(r"^\| \[(\d)\]\(#paper-\d\) \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|$", re.M)


def cells_of(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]


def rows_of(text):
    """(line, paper, cells) of each row below the heading of a paper."""
    paper = None
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        found = PAPER.match(line)
        paper = found[1] if found else paper
        is_head = number < len(lines) and lines[number].startswith("| ---")
        if paper and line.startswith("|") and not line.startswith("| ---") and not is_head:
            yield number, paper, cells_of(line)


def verdict_of(here):
    return next((verdict for verdict in VERDICTS if here.startswith(verdict)), None)


def mistakes_of_row(cells):
    if len(cells) != 3:
        return [f"{len(cells)} cells, expected statement, here and shown by"]
    statement, here, shown = cells
    verdict = verdict_of(here)
    if not statement or verdict is None:
        return [f"'{here}' begins with none of: {', '.join(VERDICTS)}"]
    if verdict == VERDICTS[0] and not LINK.search(shown):
        return [f"nothing shows '{statement}'"]
    return []


def mistakes_of_totals(text, rows):
    counted = {}
    for _, paper, cells in rows:
        counts = counted.setdefault(paper, [0, 0, 0])
        counts[VERDICTS.index(verdict_of(cells[1]))] += 1
    told = {paper: [int(number) for number in numbers] for paper, *numbers in TOTALS.findall(text)}
    for paper in sorted(told.keys() | counted.keys()):
        expected = [sum(counted.get(paper, [])), *counted.get(paper, [0, 0, 0])]
        if told.get(paper) != expected:
            yield f"the totals of paper {paper} are {told.get(paper)}, its rows say {expected}"


def deployments_of(rows):
    return sorted({path for _, _, cells in rows for path in LINK.findall(cells[-1]) if DEPLOYMENT.search(path)})


def mistake_of_deployment(file):
    done = subprocess.run([PROGRAMS / "armature", "check", file], capture_output=True, text=True, check=False)
    return f"{file} does not pass the check:\n{done.stdout}{done.stderr}" if done.returncode != 0 else None


def mistakes_of(root, known, check_deployments=True):
    """What is wrong with the page of the tree `root`."""
    page = root / PAGE
    text = page.read_text(encoding="utf-8")
    rows = list(rows_of(text))
    found = [f"{PAGE}:{number}: {mistake}" for number, _, cells in rows for mistake in mistakes_of_row(cells)]
    found += list(rules_test.mistakes_of(page, LEAST_ROWS, known)) + list(links_test.broken_links(root, page))
    if found:
        return found
    found = list(mistakes_of_totals(text, rows))
    if check_deployments:
        files = (page.parent / path for path in deployments_of(rows))
        found += filter(None, (mistake_of_deployment(file) for file in files))
    return found


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = rules_test.existing_tests(SOURCE)
        cls.text = (SOURCE / PAGE).read_text(encoding="utf-8")

    def mistakes_with(self, text, check_deployments=False):
        """Of a copy of the tree that has `text` for the page."""
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "docs").mkdir()
            for parent in ("", "docs"):
                for each in (SOURCE / parent).iterdir():
                    if not (root / parent / each.name).exists() and each.name != Path(PAGE).name:
                        (root / parent / each.name).symlink_to(each)
            (root / PAGE).write_text(text, encoding="utf-8")
            return "\n".join(mistakes_of(root, self.known, check_deployments))

    def assert_found(self, pattern, replacement, says, **options):
        text, count = re.subn(pattern, replacement, self.text, count=1, flags=re.M)
        self.assertEqual(count, 1, pattern)
        self.assertRegex(self.mistakes_with(text, **options), says)

    def test_it_names_what_there_is(self):
        self.assertEqual(mistakes_of(SOURCE, self.known), [])

    def test_it_has_a_row_for_each_statement(self):
        self.assertGreaterEqual(len(list(rows_of(self.text))), LEAST_ROWS)

    def test_a_copy_is_as_good_as_the_page(self):
        self.assertEqual(self.mistakes_with(self.text), "")

    def test_an_unknown_test_is_found(self):
        self.assert_found(r'"SamplerTest\.', '"SamplerTest.No', "unknown test SamplerTest.No")

    def test_a_test_of_another_file_is_found(self):
        self.assert_found(r"\[sampler_test\]\(\S+", "[pid_test](../armature/controllers/pid/pid_test.cpp",
                          "is in .*sampler_test.cpp, not in")

    def test_an_unknown_file_is_found(self):
        self.assert_found(r"\(\.\./robots/janus/deployments/pid\.yaml", "(../robots/janus/deployments/pd.yaml",
                          "unknown target '../robots/janus/deployments/pd.yaml'")

    def test_a_row_that_nothing_shows_is_found(self):
        self.assert_found(r"^\| ([^|\n]+) \| as written \| [^|\n]+ \|$", r"| \1 | as written | |", "nothing shows '")

    def test_a_row_without_a_verdict_is_found(self):
        self.assert_found(r"\| as written \| \[", "| nearly | [", "'nearly' begins with none of")

    def test_a_row_with_a_cell_too_few_is_found(self):
        self.assert_found(r" \| as written \| \[", " | as written [", "2 cells, expected")

    def test_wrong_totals_are_found(self):
        self.assert_found(r"\| differs: ", "| as written: ", r"the totals of paper 1 are \[")

    def test_a_deployment_that_does_not_pass_is_found(self):
        self.assert_found(r"\(\.\./robots/janus/deployments/pid\.yaml",
                          "(../tests/deployment/mistakes/no_model.yaml", "does not pass the check",
                          check_deployments=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
