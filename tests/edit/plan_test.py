#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The plan of a deployment is the same after its components are grouped or dissolved: threads, periods,
priorities and orders, up to names.

usage: plan_test.py SOURCE_FOLDER ARMATURE LIBRARY_FOLDER"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, ARMATURE, LIBRARIES = pathlib.Path(sys.argv[1]), *sys.argv[2:4]

# A deployment, what is made of it, and what that puts in front of names.
CASES = [
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Source,Filter"], "G."),
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Filter,Watcher"], "G."),
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Source,Filter,Watcher"], "G."),
    ("examples/05_composite/chassis.yaml", ["--group", "G=Driver,Rover"], "G."),
    ("examples/05_composite/chassis.yaml", ["--dissolve", "Rover"], "Rover."),
]


def plan(deployment: pathlib.Path) -> str:
    done = subprocess.run([ARMATURE, "check", "--order", "-L", LIBRARIES, str(deployment)], check=True, capture_output=True, text=True)
    return "\n".join(line for line in done.stdout.splitlines() if not line.startswith("armature: "))


def without(prefix: str, text: str) -> str:
    return re.sub(rf"\b{re.escape(prefix)}", "", text)


class Plans(unittest.TestCase):
    def test_threads_and_orders_stay_up_to_names(self):
        for name, edits, prefix in CASES:
            with self.subTest(name, edits=edits), tempfile.TemporaryDirectory() as folder:
                shutil.copytree((SOURCE / name).parent, folder, dirs_exist_ok=True)
                deployment = pathlib.Path(folder) / pathlib.Path(name).name
                before = plan(deployment)
                subprocess.run([ARMATURE, "edit", str(deployment), *edits], check=True, capture_output=True)
                after = plan(deployment)
                self.assertIn("updates", before)
                self.assertNotEqual(before, after)
                self.assertEqual(without(prefix, before), without(prefix, after))


unittest.main(argv=sys.argv[:1])
