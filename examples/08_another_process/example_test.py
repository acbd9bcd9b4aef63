#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the robot and, in another process, the pilot; then the pilot alone.

usage: example_test.py ROBOT PILOT
"""
import subprocess
import sys
import tempfile

robot, pilot = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    address = f"unix:{folder}/robot.sock"
    with subprocess.Popen([robot, address], stdout=subprocess.PIPE, text=True) as serving:
        try:
            assert serving.stdout.readline() == f"the robot is at {address}\n"
            done = subprocess.run([pilot, address], capture_output=True, text=True, timeout=120)
        finally:
            serving.kill()
    assert done.returncode == 0, done.stdout + done.stderr
    refusal, arrival = done.stdout.splitlines()
    assert "parameter red is 300, expected 0 to 255" in refusal, refusal
    assert arrival == "the ball is in the middle", arrival

    alone = subprocess.run([pilot, address], capture_output=True, text=True, timeout=120)
    assert alone.returncode == 1 and alone.stderr.startswith("pilot: "), alone
    assert "robot.sock" in alone.stderr, alone.stderr
