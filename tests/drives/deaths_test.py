#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The arm of examples/12_cia402 and its emulated drives as two processes, of which one dies or is stopped. The
period is ten times the example's, so that a busy machine seldom holds up the arm for three of them. Where it does, nothing
moves, as promised; then the operator puts the arm back into service, and arms again.

usage: deaths_test.py PROGRAM EMULATOR LIBRARIES EXAMPLES
"""

import os
import re
import signal
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import Process, wait_for

PROGRAM, EMULATOR, LIBRARIES, EXAMPLES = sys.argv[1:5]
SLOWER = """
include: {examples}/12_cia402/on_can.yaml
components:
  Sampler: {{override: true, activity: {{periodic: 20 ms, priority: 80}}}}
  Arming: {{override: true, activity: {{periodic: 20 ms, priority: 30}}}}
  Generator: {{override: true, activity: {{periodic: 20 ms, priority: 40}}}}
  Joint{{1..2}}: {{override: true, properties: {{MaxPositionError: 10 deg}}}}
"""
STATE = re.compile(r"node (\d+): [^,]*, ([^,]*), [^,]*, (\S+) rad, (\S+) rad/s")


class Deaths(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        bus = os.path.join(self.folder.name, "arm.bus")
        self.drives = Process([EMULATOR, "--drives", "2", "--bus", "virtual:" + bus], self.folder.name)
        wait_for(lambda: os.path.exists(bus), "the emulator is there")
        deployment = os.path.join(self.folder.name, "deployment.yaml")
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(SLOWER.format(examples=EXAMPLES))
        self.arm = Process([PROGRAM, "run", deployment, "-L", LIBRARIES, "--set", "Bus.bus=virtual:" + bus, "--browse"],
                           self.folder.name)
        wait_for(lambda: "armature: service:" in self.arm.text() or self.arm.process.poll() is not None, "it runs")
        self.assertIsNone(self.arm.process.poll(), self.arm.text())
        time.sleep(0.5)  # drives have answered
        self.put_in_motion(lambda: self.is_armed(), "")

    def tearDown(self):
        for process in (self.arm, self.drives):
            if process.process.poll() is None:
                process.process.send_signal(signal.SIGCONT)
                process.process.kill()
            process.process.wait()
        self.folder.cleanup()

    def put_in_motion(self, moves, motion):
        """Armed, and told to move, again if the machine has held it up meanwhile."""
        for _ in range(10):
            self.arm.say("reset")
            self.arm.say("start")
            for node in (1, 2):
                self.arm.say(f"Bus:resetDrive({node})")
                self.arm.say(f"if not Drive{node}.position_exact then Drive{node}.position_confirmed = true end")
            self.arm.ask("wait(0.2)")
            self.arm.ask("pcall(function() return wait(Arming:arm()) end)")
            if not self.is_armed():
                continue
            if motion:
                self.arm.say(motion)
            try:
                wait_for(lambda: moves() or not self.is_armed(), "it moves")
            except AssertionError:
                continue
            if moves():
                return
        self.fail("it never moves: " + self.arm.text())

    def is_armed(self):
        return self.arm.ask("Arming.armed") == "true"

    def states(self):
        """Of both drives: power, position, velocity."""
        begin = len(self.drives.lines)
        self.drives.say("state")
        found = lambda: [m.groups() for m in map(STATE.match, self.drives.lines[begin:]) if m]
        wait_for(lambda: len(found()) >= 2, "the drives say how they are")
        return [(power, float(position), float(velocity)) for _, power, position, velocity in found()[:2]]

    def begin_motion(self):
        self.put_in_motion(lambda: all(abs(velocity) > 0.05 for _, _, velocity in self.states()),
                           "Generator:moveTo(array(1.4, -1.4), 10.0)")

    def assert_rests(self):
        wait_for(lambda: all(power in ("switch on disabled", "fault") for power, _, _ in self.states()),
                 "both drives are off")
        before = self.states()
        time.sleep(0.3)
        for (_, there, _), (power, here, velocity) in zip(before, self.states()):
            self.assertNotEqual(power, "operation enabled")
            self.assertAlmostEqual(here, there, places=3)
            self.assertAlmostEqual(velocity, 0.0, places=3)
            self.assertLess(abs(here), 1.3, "it did not go on to its target")

    def test_it_is_armed_and_moves(self):
        self.put_in_motion(lambda: self.states()[0][1] > 0.25 and self.states()[1][1] < -0.25,
                           "Generator:moveTo(array(0.3, -0.3), 2.0)")

    def test_of_a_killed_controller_the_guardian_stops_the_drives(self):
        self.begin_motion()
        self.arm.process.kill()
        self.assert_rests()

    def test_of_a_controller_that_is_stopped_the_guardian_stops_the_drives_and_it_faults_when_it_goes_on(self):
        self.begin_motion()
        self.arm.process.send_signal(signal.SIGSTOP)
        self.assert_rests()
        self.arm.process.send_signal(signal.SIGCONT)
        wait_for(lambda: "Bus: fault" in self.arm.text(), "the host faults: " + self.arm.text())
        self.assert_rests()

    def test_drives_that_die_are_a_fault_of_the_controller(self):
        self.begin_motion()
        self.drives.process.kill()
        wait_for(lambda: re.search(r"Drive\d: fault", self.arm.text()), "the drives' components fault")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
