#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What is held at a stop is let go of by who has seen the question only: lines of a pipe were written
before it was asked.

usage: holding_test.py PROGRAM FOLDER_OF_VICTIM
"""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, VICTIM = sys.argv[1:3]
DEPLOYMENT = """
application: holding
libraries: [victim]
hold_at_stop: 1 s
components:
  Weight: {model: Weight, activity: {periodic: 10 ms}}
"""


class Piped(unittest.TestCase):
    def run_with(self, *lines):
        with tempfile.TemporaryDirectory() as folder:
            deployment = os.path.join(folder, "holding.yaml")
            with open(deployment, "w", encoding="utf-8") as file:
                file.write(DEPLOYMENT)
            return subprocess.run([PROGRAM, "run", deployment, "-L", VICTIM, "--sim", "--browse"],
                                  input="\n".join(lines) + "\n", capture_output=True, text=True, timeout=60)

    def test_quit_of_a_pipe_is_no_answer(self):
        for lines in (["quit"], ["quit", "quit", "quit"], ["run 1"]):
            with self.subTest(lines=lines):
                done = self.run_with(*lines)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("'Weight' lets go, since no answer came: it held a weight", done.stderr)

    def test_what_a_pipe_says_of_it_counts(self):
        done = self.run_with("Weight.in_hand = true", "quit")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_with("quit", "quit", "Weight.in_hand = true")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("before the stop, 'Weight' holds a weight", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
