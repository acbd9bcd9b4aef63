#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The generator of the Janus head commanded from a second process.

usage: remote_test.py PROGRAM LIBRARIES JANUS_DIR

Nothing here depends on how fast the machine is but that the head, which moves in real time, is not
held up for so long that it has to stop: that is tried several times.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, LIBRARIES, JANUS = map(os.path.abspath, sys.argv[1:4])
LONG = 60.0
ATTEMPTS = 10


def armature(*arguments, **how):
    return subprocess.Popen([PROGRAM, *arguments], text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, **how)


def deployment(name):
    return os.path.join(JANUS, "deployments", name)


class Remote(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.address = f"unix:{self.folder.name}/robot.sock"

    def start_robot(self):
        robot = armature("run", "-L", LIBRARIES, "--set", f"address={self.address}",
                         deployment("served.yaml"), cwd=self.folder.name)  # for its black box
        self.addCleanup(robot.stdout.close)
        self.addCleanup(robot.wait)
        self.addCleanup(robot.kill)
        end = time.monotonic() + LONG
        while not os.path.exists(self.address.removeprefix("unix:")):
            self.assertLess(time.monotonic(), end, "the robot does not listen")
            self.assertIsNone(robot.poll(), "the robot has ended")
            time.sleep(0.01)
        return robot

    def stop(self, robot):
        robot.send_signal(signal.SIGINT)
        text, _ = robot.communicate(timeout=LONG)
        return text

    def operate(self, script):
        operator = armature("run", "--realtime", "off", "-L", LIBRARIES, "--set",
                            f"robot={self.address}", "--script", script,
                            deployment("operator.yaml"))
        text, _ = operator.communicate(timeout=LONG)
        return operator.returncode, text

    def browse(self, lines):
        browser = armature("browse", self.address, stdin=subprocess.PIPE)
        text, _ = browser.communicate(lines, timeout=LONG)
        return browser.returncode, text

    def test_another_process_arms_the_head_and_moves_it(self):
        for _ in range(ATTEMPTS):
            robot = self.start_robot()
            code, text = self.operate(os.path.join(JANUS, "look.lua"))
            said = self.stop(robot)
            if code == 0:
                break
        self.assertEqual(code, 0, text + said)
        self.assertIn("armed\nlooks to the side\nand ahead\ntoo far: ", text)
        self.assertIn("expected -0.5 to 4.5", text)
        self.assertIn("Joint1: armed", said)
        self.assertEqual(robot.returncode, 0, said)

    def test_who_may_only_look_does_nothing_else(self):
        robot = self.start_robot()
        code, text = self.browse("Joint1.GearRatio\nJoint1.GearRatio = 0.5\nPID1.Kp = 1\n"
                                 "Joint1.GearRatio\n")
        self.assertEqual(code, 1, text)
        self.assertEqual(text.count("0.01"), 2, text)
        self.assertIn("may not configure 'Joint1'", text)
        self.assertIn("may not configure 'PID1'", text)
        self.stop(robot)

    def test_the_head_rests_when_the_operator_is_killed(self):
        for _ in range(ATTEMPTS):
            robot = self.start_robot()
            operator = armature("run", "--realtime", "off", "-L", LIBRARIES, "--set",
                                f"robot={self.address}", "--script",
                                os.path.join(JANUS, "look.lua"), deployment("operator.yaml"))
            self.addCleanup(operator.stdout.close)
            armed = "armed\n" in iter(operator.stdout.readline, "")
            operator.kill()
            operator.wait()
            if armed:
                break
            self.stop(robot)
        self.assertTrue(armed)
        end = time.monotonic() + LONG
        while True:  # the motion that was begun is cancelled, and nothing follows
            self.assertLess(time.monotonic(), end, "the head does not come to rest")
            _, velocity = self.browse("Generator.nAxesDesiredVelocity\n")
            if velocity.startswith("[0, 0]"):
                break
        self.assertIn("Joint1: armed", self.stop(robot))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
