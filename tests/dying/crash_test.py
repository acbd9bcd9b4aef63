#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What becomes of a run in which a component crashes or calls exit: who it was is named with its
call stack, all others stop in order, the black box is written, and the exit code is not 0.

usage: crash_test.py PROGRAM FOLDER_OF_VICTIM
"""

import glob
import os
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM, VICTIM = sys.argv[1:3]

DEPLOYMENT = """
application: dying
libraries: [hello, victim]
components:
  Greeter: {model: Greeter, activity: {periodic: 100 ms}}
  Victim: {model: Victim, activity: {periodic: 10 ms}, properties: {How: %s, After: 30}}
"""


class Crash(unittest.TestCase):
    def run_with(self, how, *arguments, typed=None):
        """The run that ended, and the names of its black boxes."""
        with tempfile.TemporaryDirectory() as folder:
            deployment = os.path.join(folder, "dying.yaml")
            with open(deployment, "w", encoding="utf-8") as file:
                file.write(DEPLOYMENT % how)
            done = subprocess.run([PROGRAM, "run", deployment, "-L", VICTIM, "--for", "60s", "--out", folder, *arguments],
                                  capture_output=True, text=True, timeout=120, input=typed)
            return done, glob.glob(os.path.join(folder, "blackbox-*"))

    def assert_dies(self, how, code, says, function):
        for arguments in ([], ["--sim"]):
            with self.subTest(how=how, arguments=arguments):
                done, boxes = self.run_with(how, *arguments)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(f"fatal: 'Victim' in the thread 'Victim'{says}", done.stderr)
                self.assertRegex(done.stderr, rf"{function}.*\[libvictim\.so\+0x[0-9a-f]+\]")
                self.assertRegex(done.stderr, "Greeter: goodbye after [0-9]+ greetings")
                self.assertEqual(len(boxes), 1, done.stderr)

    def test_exit_in_a_component_is_a_failure_also_with_0(self):
        self.assert_dies("exit", 1, " has called exit(0)", r"Victim::")

    def test_a_segmentation_fault_is_named_with_its_component_thread_and_stack(self):
        self.assert_dies("segv", -signal.SIGSEGV, ": segmentation fault at address 0x10", "write_nowhere")

    def test_an_abort_is(self):
        self.assert_dies("abort", -signal.SIGABRT, ": abort", r"Victim::")

    def test_an_exception_that_nobody_may_see_is(self):
        self.assert_dies("terminate", -signal.SIGABRT, ": abort", r"Victim::")

    def test_a_stack_overflow_is(self):
        self.assert_dies("overflow", -signal.SIGSEGV, ": stack overflow", "overflow")

    def test_a_crash_in_what_the_browser_called_is_no_different(self):
        done, boxes = self.run_with("none", "--browse", typed="Victim:die('segv')\nwait\n")
        self.assertEqual(done.returncode, -signal.SIGSEGV, done.stderr)
        self.assertIn("fatal: 'Victim' in the thread 'Victim': segmentation fault", done.stderr)
        self.assertRegex(done.stderr, "Greeter: goodbye after [0-9]+ greetings")
        self.assertEqual(len(boxes), 1, done.stderr)

    def test_an_order_to_stop_is_none_of_these(self):
        done, boxes = self.run_with("none", "--sim")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(boxes, [])
        self.assertNotIn("fatal", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
