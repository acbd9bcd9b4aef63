#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `armature edit` makes of files, and when it leaves them alone.

usage: edit_test.py PROGRAM EXAMPLES_DIR
"""

import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

PROGRAM, EXAMPLES = sys.argv[1:3]


def armature(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


class Editing(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.wave = self.copy("02_ports_and_triggers/wave.yaml")

    def copy(self, example):
        path = os.path.join(self.folder.name, os.path.basename(example))
        shutil.copy(os.path.join(EXAMPLES, example), path)
        return path

    def read(self, path):
        with open(path, newline="") as file:
            return file.read()

    def edit(self, *arguments, code=0):
        done = armature("edit", *arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_several_edits_in_the_order_in_which_they_are_typed(self):
        before = self.read(self.wave)
        done = self.edit(self.wave, "--add", "Log=Watcher", "--set", "Log.activity.periodic=100 ms",
                         "--connect", "Filter.Filtered", "Log.Value", "--policy", "max_age: 1 s",
                         "--set", "Filter.Weight=0.5", "--rename", "Log=Second",
                         "--disconnect", "Filter.Filtered", "Watcher.Value", "--remove", "Watcher")
        self.assertEqual(done.stderr, f"armature: wrote {self.wave}\n")
        expected = before.replace("Weight: 0.2", "Weight: 0.5").replace(
            "  Watcher: {model: Watcher, activity: {periodic: 200 ms}}",
            "  Second: {model: Watcher, activity: {periodic: 100 ms}}").replace(
            "  - Filter.Filtered -> Watcher.Value",
            "  - {from: Filter.Filtered, to: Second.Value, max_age: 1 s}")
        self.assertEqual(self.read(self.wave), expected)

    def test_a_deployment_that_was_edited_is_checked_and_runs(self):
        self.edit(self.wave, "--add", "Second=Watcher", "--set", "Second.activity={periodic: 100 ms}",
                  "--connect", "Filter.Filtered", "Second.Value")
        done = armature("run", "--sim", "--for", "1s", self.wave)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("Second:"), 10, done.stderr)

    def test_dry_run_shows_the_difference_and_writes_nothing(self):
        before = self.read(self.wave)
        done = self.edit(self.wave, "--set", "Filter.Weight=0.5", "--dry-run")
        self.assertEqual(self.read(self.wave), before)
        self.assertTrue(done.stdout.startswith(f"--- {self.wave}\n+++ {self.wave}\n@@ -"), done.stdout)
        changes = [line for line in done.stdout.splitlines()[3:] if line[0] in "+-"]
        self.assertEqual([line[:11] for line in changes], ["-  Filter: ", "+  Filter: "])

    def test_one_that_is_refused_leaves_all_undone(self):
        before = self.read(self.wave)
        done = self.edit(self.wave, "--set", "Filter.Weight=0.5", "--remove", "Fliter", code=1)
        self.assertIn("error: remove Fliter is refused: unknown component 'Fliter' (did you mean 'Filter'?)",
                      done.stderr)
        self.assertEqual(self.read(self.wave), before)

    def test_a_file_keeps_its_permissions_and_its_links(self):
        os.chmod(self.wave, 0o640)
        link = os.path.join(self.folder.name, "link.yaml")
        os.symlink(self.wave, link)
        self.edit(link, "--set", "Filter.Weight=0.5")
        self.assertTrue(os.path.islink(link))
        self.assertEqual(stat.S_IMODE(os.stat(self.wave).st_mode), 0o640)
        self.assertIn("Weight: 0.5", self.read(self.wave))

    def test_an_included_file_changes_when_it_is_named(self):
        arm = self.copy("07_own_robot/arm.yaml")
        controller = self.copy("07_own_robot/controller.yaml")
        before = self.read(controller)
        done = self.edit(arm, "--set", "period=5 ms", code=1)
        self.assertIn(f"(change that file with --in {controller}, or override it here with --override)",
                      done.stderr)
        self.edit(arm, "--set", "period=5 ms", "--in", controller)
        self.assertEqual(self.read(controller), before.replace("period: 10 ms", "period: 5 ms"))
        self.edit(arm, "--set", "period=2 ms", "--override")
        self.assertIn("\n  period: 2 ms\n", self.read(arm))
        self.assertEqual(self.read(controller), before.replace("period: 10 ms", "period: 5 ms"))

    def test_orocos_files_are_not_edited(self):
        xml = os.path.join(self.folder.name, "wave.xml")
        self.assertEqual(armature("convert", self.wave, xml).returncode, 0)
        self.assertIn("OROCOS files are not edited", self.edit(xml, "--add", "A=B", code=1).stderr)

    def test_wrong_use(self):
        for arguments, says in ((["--dry-run"], "nothing to edit"),
                                (["--set", "Filter.Weight"], "must have the form NAME=VALUE"),
                                (["--connect", "A.x"], "--connect"),
                                (["--policy", "max_age: 1 s"], "--policy follows the --connect"),
                                (["--ste", "a=b"], "did you mean '--set'?")):
            done = self.edit(self.wave, *arguments, code=2)
            self.assertIn(says, done.stderr + done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
