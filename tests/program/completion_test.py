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
import unittest

ARMATURE = pathlib.Path(sys.argv[1])
SOURCE = pathlib.Path(sys.argv[2])
FILE = str(SOURCE / "examples/07_own_robot/arm.yaml")
MODES = str(SOURCE / "robots/janus/deployments/modes.yaml")
SCRIPTS = SOURCE / "packaging/completion"
ENVIRONMENT = dict(os.environ, PATH=f"{ARMATURE.parent}:{os.environ['PATH']}")


def complete(*words):
    done = subprocess.run([ARMATURE, "complete", "--", *words], capture_output=True, text=True, check=True)
    return done.stdout.split()


def in_bash(*words):
    """What bash would show for `armature WORDS`."""
    script = f"""
        source {SCRIPTS}/armature.bash
        compopt() {{ echo "option $2"; }}
        COMP_WORDS=(armature "$@")
        COMP_CWORD=$#
        _armature
        printf '%s\\n' "${{COMPREPLY[@]}}"
    """
    done = subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True, check=True, env=ENVIRONMENT)
    return done.stdout.split("\n")[:-1]


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

    def test_bash_goes_on_after_a_component_and_looks_for_files_itself(self):
        self.assertEqual(in_bash("stu"), ["studio"])
        self.assertEqual(in_bash("run", FILE, "--set", "Joint3"), ["option nospace", "Joint3."])
        self.assertEqual(in_bash("run", "exam"), ["option default", ""])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_reads_its_script(self):
        subprocess.run(["zsh", "-n", SCRIPTS / "_armature"], check=True)

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        line = f"source {SCRIPTS}/armature.fish; complete -C 'armature run {FILE} --set Joint3'"
        done = subprocess.run(["fish", "-c", line], capture_output=True, text=True, check=True, env=ENVIRONMENT)
        self.assertEqual(done.stdout.split(), ["Joint3."])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
