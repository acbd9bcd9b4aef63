#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program armature-wam-emulator as people and other programs use it.

usage: emulator_program_test.py PROGRAM
"""

import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
PATIENCE = 20  # seconds


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.bus = "virtual:" + os.path.join(self.folder.name, "wam.bus")

    def run_with(self, *arguments, text=""):
        return subprocess.run([PROGRAM, *arguments], input=text, capture_output=True, text=True, timeout=PATIENCE)

    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, "--bus", self.bus, *arguments], stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

        def end():
            process.kill()
            process.communicate()

        self.addCleanup(end)
        return process

    @staticmethod
    def say(process, command):
        process.stdin.write(command + "\n")
        process.stdin.flush()

    @staticmethod
    def state_with(process, condition):
        """The first state that fulfils it."""
        for line in process.stdout:
            state = json.loads(line)
            if condition(state):
                return state
        raise AssertionError("the program has ended")

    def test_help_tells_options_keys_and_commands(self):
        told = self.run_with("--help")
        self.assertEqual(told.returncode, 0)
        for part in ("--bus", "--joints", "--state", "--log", "Shift+Activate", "fault puck N silent"):
            self.assertIn(part, told.stdout)

    def test_wrong_use_ends_with_2(self):
        for arguments in ([], ["--bus", self.bus, "--joints", "5"], ["--bus", self.bus, "--firmware", "1"],
                          ["--buss", "x"]):
            self.assertEqual(self.run_with(*arguments).returncode, 2, arguments)

    def test_what_cannot_be_done_ends_with_1_and_is_said(self):
        told = self.run_with("--bus", "virtual:/nonexistent/wam.bus")
        self.assertEqual(told.returncode, 1)
        self.assertRegex(told.stderr, r"^armature-wam-emulator: error: bus '/nonexistent/wam.bus'")
        told = self.run_with("--bus", self.bus, "--start", "1,2")
        self.assertEqual(told.returncode, 1)
        self.assertIn("start has 2 numbers, expected 7", told.stderr)

    def test_a_mistake_in_a_line_is_said_and_the_next_one_is_done(self):
        told = self.run_with("--bus", self.bus, "--joints", "4", text="fault puck 7 silent\ndance\nquit\n")
        self.assertEqual(told.returncode, 0)
        self.assertIn("a puck of this arm, 1 to 4, found '7'", told.stderr)
        self.assertIn("'dance' is not a command", told.stderr)

    def test_lines_are_the_pendants_keys_and_states_tell_what_they_do(self):
        arm = self.start("--joints", "4", "--state", "-", "--start", "0.5,-1.5,0,2")
        first = self.state_with(arm, lambda state: True)
        self.assertEqual(first["mode"], "estop")
        self.assertAlmostEqual(first["position"][0], 0.5, delta=0.05)
        self.say(arm, "release")
        self.say(arm, "idle")
        self.state_with(arm, lambda state: state["mode"] == "idle" and state["pucks"] == ["monitor"] * 4)
        self.say(arm, "activate")
        self.state_with(arm, lambda state: state["mode"] == "active")
        # Nobody sends torques, which the board minds.
        self.state_with(arm, lambda state: state["mode"] == "idle" and state["monitors"]["heartbeat"] == "fault")
        self.say(arm, "idle")
        self.say(arm, "home")
        self.state_with(arm, lambda state: state["carried"] and state["monitors"]["heartbeat"] == "safe")

    def test_a_signal_ends_it_in_order_and_its_bus_is_gone(self):
        arm = self.start("--state", "-")
        self.state_with(arm, lambda state: True)
        arm.send_signal(signal.SIGTERM)
        _, errors = arm.communicate(timeout=PATIENCE)
        self.assertEqual(arm.returncode, 0)
        self.assertTrue(errors.endswith("the arm is switched off\n"), errors)
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_it_goes_on_when_standard_input_has_ended(self):
        arm = self.start("--state", "-")
        arm.stdin.close()
        begin = self.state_with(arm, lambda state: True)["time"]
        self.state_with(arm, lambda state: state["time"] > begin + 0.5)
        arm.stdin = None
        arm.send_signal(signal.SIGINT)
        self.assertEqual(arm.wait(timeout=PATIENCE), 0)

    def test_the_log_has_the_boards_frames_as_candump_writes_them(self):
        file = os.path.join(self.folder.name, "log")
        arm = self.start("--state", "-", "--log", file)
        self.say(arm, "release\nidle")
        self.state_with(arm, lambda state: state["pucks"][0] == "monitor")
        self.say(arm, "activate")
        self.state_with(arm, lambda state: state["frames"] >= 1)
        self.say(arm, "quit")
        arm.communicate(timeout=PATIENCE)
        with open(file, encoding="utf-8") as log:
            lines = log.read().splitlines()
        self.assertTrue(lines)
        for line in lines:
            self.assertRegex(line, re.compile(r"^\(\d{10}\.\d{6,9}\) can0 [0-9A-F]{3}#[0-9A-F]*$"))


unittest.main(verbosity=2)
