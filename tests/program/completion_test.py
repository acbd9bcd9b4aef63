#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shells complete the command line of armature.

usage: completion_test.py ARMATURE SOURCE_DIR
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from shells import completed

ARMATURE = pathlib.Path(sys.argv[1])
SOURCE = pathlib.Path(sys.argv[2])
FILE = str(SOURCE / "examples/07_own_robot/arm.yaml")
MODES = str(SOURCE / "robots/janus/deployments/modes.yaml")
SCRIPTS = SOURCE / "packaging/completion"
ENVIRONMENT = dict(os.environ, PATH=f"{ARMATURE.parent}:{os.environ['PATH']}")


def complete(*words):
    done = subprocess.run([ARMATURE, "complete", "--", *words], capture_output=True, text=True, check=True)
    return done.stdout.split()


class Completion(unittest.TestCase):
    def test_of_nothing_are_the_commands_that_the_help_has(self):
        self.assertIn("run", complete(""))
        self.assertNotIn("complete", complete(""))
        self.assertEqual(complete("stu"), ["studio"])
        self.assertEqual(complete("new", ""), ["component", "robot"])

    def test_of_a_dash_are_the_options_of_the_command(self):
        self.assertEqual(complete("run", "--scr"), ["--script"])
        self.assertIn("--order", complete("check", FILE, "--"))
        self.assertNotIn("--order", complete("run", FILE, "--"))

    def test_a_setting_is_a_component_and_then_one_of_its_properties(self):
        self.assertIn("Joint2.", complete("run", FILE, "--set", "Jo"))
        self.assertEqual(complete("run", FILE, "--set", "Joint2.GearR"), ["Joint2.GearRatio="])
        self.assertEqual(complete("run", FILE, "--set", "joi"), ["joints="])

    def test_what_a_component_says_of_itself_cannot_be_set(self):
        self.assertEqual(complete("run", FILE, "--set", "Joint2.clipp"), [])

    def test_modes_are_those_of_the_file(self):
        self.assertEqual(complete("run", MODES, "--mode", ""), sorted(complete("run", MODES, "--mode", "")))
        self.assertIn("pid", complete("run", MODES, "--mode", "p"))

    def test_files_are_left_to_the_shell(self):
        self.assertEqual(complete("run", "examples/"), [])
        self.assertEqual(complete("run", "no_such_file.yaml", "--set", ""), [])


class AtATerminal(unittest.TestCase):
    def completes(self, shell, preparation):
        """A command, a component, a property, a whole name, a folder."""
        lines = {
            "armature stu": "armature studio ",
            f"armature run {FILE} --set Joint3": f"armature run {FILE} --set Joint3.",
            f"armature run {FILE} --set Joint3.GearR": f"armature run {FILE} --set Joint3.GearRatio=",
            f"armature run {FILE} --only Sampl": f"armature run {FILE} --only Sampler ",
            f"armature run {SOURCE}/exampl": f"armature run {SOURCE}/examples/",
        }
        with tempfile.TemporaryDirectory() as home:
            found = completed(shell, preparation, lines, environment={**ENVIRONMENT, "HOME": home})
        self.assertEqual(found, list(lines.values()))

    def test_bash_completes(self):
        self.completes("bash", f"source {SCRIPTS}/armature.bash")

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_completes(self):
        self.completes("zsh", f"fpath=({SCRIPTS} $fpath); autoload -Uz compinit; compinit -u -D")

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        self.completes("fish", f"source {SCRIPTS}/armature.fish")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
