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

# A deployment, what is made of it, and what that puts in front of names.
CASES = [
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Source,Filter"], "G."),
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Filter,Watcher"], "G."),
    ("examples/02_ports_and_triggers/wave.yaml", ["--group", "G=Source,Filter,Watcher"], "G."),
    ("examples/05_composite/chassis.yaml", ["--group", "G=Driver,Rover"], "G."),
    ("examples/05_composite/chassis.yaml", ["--dissolve", "Rover"], "Rover."),
]


def plan(armature: str, libraries: str, deployment: pathlib.Path) -> str:
    done = subprocess.run([armature, "check", "--order", "-L", libraries, str(deployment)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return "\n".join(line for line in done.stdout.splitlines() if not line.startswith("armature: "))


def test_threads_and_orders_stay_up_to_names(source: pathlib.Path, armature: str, libraries: str, case: tuple) -> str:
    name, edits, prefix = case
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree((source / name).parent, folder, dirs_exist_ok=True)
        deployment = pathlib.Path(folder) / pathlib.Path(name).name
        before = plan(armature, libraries, deployment)
        edited = subprocess.run([armature, "edit", str(deployment), *edits], capture_output=True, text=True)
        assert edited.returncode == 0, edited.stderr
        after = plan(armature, libraries, deployment)
    strip = lambda text: re.sub(rf"\b{re.escape(prefix)}", "", text)
    if "updates" not in before or before == after:
        return f"{name}: {edits}: nothing was planned anew:\n{after}"
    return "" if strip(before) == strip(after) else f"{name}: {edits}: the plan is another one:\n{before}\n---\n{after}"


def main() -> int:
    source, armature, libraries = sys.argv[1:]
    found = [test_threads_and_orders_stay_up_to_names(pathlib.Path(source), armature, libraries, case) for case in CASES]
    mistakes = [mistake for mistake in found if mistake]
    print("\n".join(mistakes) or f"{len(CASES)} plans stay as they are up to names")
    return 1 if mistakes else 0


sys.exit(main())
