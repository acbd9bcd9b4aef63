#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program armature-cia402-emulator as people and other programs use it.

usage: emulator_program_test.py PROGRAM
"""

import os
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
WAM = str(Path(__file__).parents[2] / "robots/wam/wam7.urdf")
PATIENCE = 20  # seconds


def run(*arguments, text=""):
    return subprocess.run([PROGRAM, *arguments], input=text, capture_output=True, text=True, timeout=PATIENCE)


class Program(unittest.TestCase):
    def test_help_tells_options_and_commands(self):
        told = run("--help")
        self.assertEqual(told.returncode, 0)
        for part in ("--bus", "--drives", "--first-node", "--eds", "fail NODE [CODE]", "reboot NODE"):
            self.assertIn(part, told.stdout)

    def test_wrong_use_has_code_2_and_says_what_is_missing(self):
        told = run()
        self.assertEqual(told.returncode, 2)
        self.assertIn("--bus is missing", told.stderr)
        self.assertEqual(run("--bus", "-", "--drives", "0").returncode, 2)

    def test_nodes_that_cannot_be_have_code_1(self):
        told = run("--bus", "-", "--drives", "3", "--first-node", "126")
        self.assertEqual(told.returncode, 1)
        self.assertIn("expected nodes from 1 to 127, found 126 to 128", told.stderr)

    def test_a_shell_is_a_host(self):
        told = run("--bus", "-", text="000#0101\n601#4000100000000000\nstate\n")
        self.assertEqual(told.returncode, 0)
        self.assertEqual(told.stdout.split(), ["701#00", "581#4300100092010200"])
        self.assertIn("node 1: operational, switch on disabled, none, 0.0000 rad", told.stderr)

    def test_faults_are_told_by_their_drive(self):
        told = run("--bus", "-", "--drives", "2", "--first-node", "5", text="fail 6 0x2310\nfail 9\nnonsense\n")
        self.assertIn("086#1023210000000000", told.stdout.split())
        self.assertIn("done: fail 6 0x2310", told.stderr)
        self.assertIn("no drive has node 9, expected 5 to 6", told.stderr)
        self.assertIn("'nonsense' is not understood", told.stderr)

    def test_an_arm_has_a_drive_for_each_joint(self):
        told = run("--bus", "-", "--urdf", WAM, text="state\n")
        self.assertEqual(told.returncode, 0)
        self.assertIn("node 7: pre-operational", told.stderr)
        self.assertNotIn("node 8", told.stderr)

    def test_what_is_no_arm_is_refused(self):
        told = run("--bus", "-", "--urdf", __file__)
        self.assertEqual(told.returncode, 1)
        self.assertIn("emulator_program_test.py", told.stderr)
        self.assertEqual(run("--bus", "-", "--urdf", WAM, "--drives", "7").returncode, 2)

    def test_quit_ends_it(self):
        told = run("--bus", "-", text="quit\n000#0101\n")
        self.assertEqual(told.returncode, 0)

    def test_the_eds_is_one(self):
        told = run("--eds", "--first-node", "3")
        self.assertEqual(told.returncode, 0)
        for part in ("[6040]", "ParameterName=Controlword", "VendorName=Armature", "[1018sub4]"):
            self.assertIn(part, told.stdout)

    def test_a_virtual_bus_is_there_until_a_signal(self):
        with tempfile.TemporaryDirectory() as folder:
            bus = os.path.join(folder, "drives.bus")
            process = subprocess.Popen([PROGRAM, "--bus", "virtual:" + bus], stdin=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            try:
                self.assertIn("drives are there: 1, from node 1 on", process.stderr.readline())
                self.assertTrue(os.path.exists(bus))
                process.send_signal(signal.SIGTERM)
                self.assertEqual(process.wait(PATIENCE), 0)
            finally:
                process.kill()
                process.communicate()


if __name__ == "__main__":
    unittest.main()
