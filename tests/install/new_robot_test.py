#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `armature new robot` writes builds against an installed Armature and moves in simulation as it is.

usage: new_robot_test.py SOURCE_DIR BUILD_DIR CMAKE CXX_COMPILER

The classes are the same for any number of joints: they are compiled once for each kind of drives, with warnings as errors, and
used by the robots of the other numbers.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

JOINTS = (1, 2, 6, 7)
DESCRIPTIONS = {"robots/wam/wam7.urdf": 7, "robots/wam/wam4.urdf": 4, "robots/janus/janus.urdf": 2,
                "armature/controllers/model/testdata/pan_tilt.urdf": 2,
                "armature/controllers/forward_kinematics/testdata/two_links.urdf": 2}
PROMISING = "can"  # its drives
WARNINGS = "-Wall -Wextra -Wconversion -Wshadow -Wpedantic -Werror"


class Installed:
    def __init__(self, source, build, cmake, compiler, work):
        self.source, self.cmake, self.compiler, self.work = Path(source), cmake, compiler, Path(work)
        self.prefix = self.work / "prefix"
        self.call(cmake, "--install", build, "--prefix", self.prefix)
        self.armature = self.prefix / "bin/armature"

    def call(self, *command, cwd=None, wrong=False):
        environment = {name: value for name, value in os.environ.items() if name != "ARMATURE_LIBRARY_PATH"}
        done = subprocess.run([str(word) for word in command], cwd=cwd, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        if (done.returncode != 0) != wrong:
            sys.exit(f"error: exit code {done.returncode} of {' '.join(map(str, command))}:\n{done.stdout}")
        return done.stdout

    def new(self, folder, kind, joints, *further):
        parent = self.work / kind / folder
        parent.mkdir(parents=True)
        self.call(self.armature, "new", "robot", "arm", "--joints", joints, "--drive", kind, *further, cwd=parent)
        return parent / "arm"

    def build(self, robot, *further):
        self.call(self.cmake, "-G", "Ninja", "-S", robot, "-B", robot / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                  f"-DCMAKE_CXX_COMPILER={self.compiler}", f"-DCMAKE_CXX_FLAGS={WARNINGS}", "-DCMAKE_BUILD_TYPE=Debug", *further)
        self.call(self.cmake, "--build", robot / "build")

    def moves(self, robot):
        for file in ["simulated.yaml"] + [each.name for each in robot.glob("on_can.yaml")]:
            told = self.call(self.armature, "check", robot / file)
            if "warning:" in told:
                sys.exit(f"error: {robot / file} should have no warnings:\n{told}")
        told = self.call(self.armature, "run", "--sim", "--for", "60s", "--script", robot / "move.lua",
                         robot / "simulated.yaml")
        if told.count("from its target") != 2 * (robot / "arm.yaml").read_text().count("PositionMin:") + 2 * (
                robot / "arm.yaml").read_text().count("Continuous: true"):
            sys.exit(f"error: each joint should arrive twice:\n{told}")

    def of_kind(self, kind):
        robots = [self.new(f"of_{joints}", kind, joints) for joints in JOINTS]
        robots += [self.new(Path(file).stem, kind, joints, "--urdf", self.source / file)
                   for file, joints in DESCRIPTIONS.items()]
        # What every drive promises is compiled for half a minute: once is enough.
        self.build(robots[0], *[] if kind == PROMISING else ["-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON"])
        told = self.call("ctest", "--test-dir", robots[0] / "build")
        if ("arm_promises" in told) != (kind == PROMISING):
            sys.exit(f"error: the robot by {PROMISING} should test what drives promise:\n{told}")
        for robot in robots[1:]:
            shutil.copytree(robots[0] / "build", robot / "build")
        for robot in robots:
            self.moves(robot)
        return len(robots)

    def refusals(self):
        """Nothing is written where something is wrong."""
        parent = self.work / "refused"
        parent.mkdir()
        (parent / "taken").mkdir()
        wam = self.source / "robots/wam/wam7.urdf"
        sliding = self.work / "sliding.urdf"
        sliding.write_text(wam.read_text().replace('type="revolute"', 'type="prismatic"', 1))
        for words, said in {
            ("taken", "--joints", "2", "--drive", "none"): "'taken' exists already",
            ("janus", "--joints", "2", "--drive", "none"): "is that of a library of Armature",
            ("arm", "--joints", "9", "--drive", "none"): "expected 1 to 7 joints, found 9",
            ("arm", "--joints", "3", "--drive", "can", "--urdf", wam): "has 7 joints that move, expected 3; give --joints 7",
            ("arm", "--joints", "7", "--drive", "cia402", "--urdf", sliding): "slides, and what is written here is for joints that turn",
            ("arm", "--joints", "3", "--drive", "can", "--urdf", "no.urdf"): "cannot read 'no.urdf'",
            ("arm", "--joints", "3", "--drive", "ethercat"): "(known: cia402, can, none)",
        }.items():
            told = self.call(self.armature, "new", "robot", *words, cwd=parent, wrong=True)
            if said not in told:
                sys.exit(f"error: {words} should say {said!r}, not {told!r}")
        if [each.name for each in parent.rglob("*")] != ["taken"]:
            sys.exit(f"error: something was written: {list(parent.rglob('*'))}")

    def runs_examples(self):
        examples = self.prefix / "share/armature/examples"
        self.call(self.armature, "run", "--sim", "--for", "60s", "--script", examples / "12_cia402/move.lua",
                  examples / "12_cia402/position.yaml")
        self.call(self.armature, "run", "--sim", "--for", "60s", "-L", self.prefix / "lib/armature/examples", "--script",
                  examples / "07_own_robot/move.lua", examples / "07_own_robot/arm.yaml")


def main():
    with tempfile.TemporaryDirectory() as work:
        installed = Installed(*sys.argv[1:5], work)
        installed.refusals()
        installed.runs_examples()
        robots = sum(installed.of_kind(kind) for kind in ("cia402", "can", "none"))
        print(f"{robots} robots move")


if __name__ == "__main__":
    main()
