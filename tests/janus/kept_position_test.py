#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The last position of a joint, as `armature run` keeps it: also when it is killed.

usage: kept_position_test.py PROGRAM LIBRARIES JANUS_DIR
"""

import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM, LIBRARIES, JANUS = sys.argv[1:4]
DEPLOYMENT = os.path.join(JANUS, "deployments", "paper2.yaml")
MOVE = """run 0.1
    assert(wait(Arming:arm()))
    assert(wait(Generator:moveTo(array(0.5, 0.25), 2)))
    run 1
"""


class KeptPosition(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.files = [os.path.join(folder.name, f"aic{joint}.cpf") for joint in (1, 2)]

    def arguments(self, command, *more):
        kept = []
        for joint, file in enumerate(self.files, start=1):
            kept += [f"--set=AIC{joint}.autosave=true", f"--set=AIC{joint}.property_file={file}"]
        return [PROGRAM, command, DEPLOYMENT, "-L", LIBRARIES, *kept, *more]

    def move(self):
        done = subprocess.run(
            self.arguments("run", "--sim", "--browse", "--set=AIC1.position_confirmed=true",
                           "--set=AIC2.position_confirmed=true"),
            input=MOVE, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertNotIn("keeps no position", done.stderr)

    def check(self):
        done = subprocess.run(self.arguments("check"), capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def kept(self, joint):
        with open(self.files[joint - 1], encoding="utf-8") as file:
            text = file.read()
        position = float(re.search(r'name="position".*?<value>(.*?)</value>', text).group(1))
        at_rest = re.search(r'name="at_rest".*?<value>(.*?)</value>', text).group(1)
        return position, at_rest

    def test_an_orderly_end_keeps_it(self):
        self.assertIn("'AIC1.Joint' begins at InitialPos, 0 rad: no position is kept yet",
                      self.check())
        self.move()
        self.assertAlmostEqual(self.kept(1)[0], 0.5, delta=1e-3)
        self.assertAlmostEqual(self.kept(2)[0], 0.25, delta=1e-3)
        self.assertEqual(self.kept(1)[1], "true")
        self.assertNotIn("InitialPos", self.check())

    def test_a_run_that_is_killed_leaves_nothing_to_believe(self):
        self.move()
        with subprocess.Popen(self.arguments("run", "--realtime", "off"), text=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as run:
            while "asked for the ordinary scheduler" not in run.stderr.readline():
                self.assertIsNone(run.poll(), "it did not start")
            run.send_signal(signal.SIGKILL)
        self.assertEqual(self.kept(1)[1], "false")
        for joint in (1, 2):
            self.assertRegex(self.check(), f"warning: 'AIC{joint}.Joint' begins at InitialPos, "
                             "0 rad: the run of .* did not end with the joint at rest")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
