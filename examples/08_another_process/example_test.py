#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the robot and, in another process, the pilot; then the pilot alone. Then the deployment, which
has no C++ of the robot: beside the robot, before it is there, and with mistakes.

usage: example_test.py ROBOT PILOT ARMATURE
"""
import pathlib
import signal
import subprocess
import sys
import tempfile

robot, pilot, armature = sys.argv[1:]
DEPLOYMENT = str(pathlib.Path(__file__).parent / "ball.yaml")


def start_robot(address):
    serving = subprocess.Popen([robot, address], stdout=subprocess.PIPE, text=True)
    assert serving.stdout.readline() == f"the robot is at {address}\n"
    return serving


def end(process):
    process.kill()
    process.communicate()


def start_deployment(address):
    return subprocess.Popen([armature, "run", DEPLOYMENT, "--set", f"robot={address}", "--for", "60s"],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def wait_for(running, text):
    """Reads what it says until it says so."""
    said = []
    for line in running.stdout:
        said.append(line)
        if text in line:
            return
    raise AssertionError(f"expected '{text}' in\n" + "".join(said))


def check_pilot(address):
    serving = start_robot(address)
    try:
        done = subprocess.run([pilot, address], capture_output=True, text=True, timeout=120)
    finally:
        end(serving)
    assert done.returncode == 0, done.stdout + done.stderr
    refusal, arrival = done.stdout.splitlines()
    assert "parameter red is 300, expected 0 to 255" in refusal, refusal
    assert arrival == "the ball is in the middle", arrival

    alone = subprocess.run([pilot, address], capture_output=True, text=True, timeout=120)
    assert alone.returncode == 1 and alone.stderr.startswith("pilot: "), alone
    assert "robot.sock" in alone.stderr, alone.stderr


def check_deployment(address):
    running = start_deployment(address)
    wait_for(running, f"'Vision' at {address} cannot be used")
    serving = start_robot(address)
    try:
        wait_for(running, "the ball is in the middle")
        running.send_signal(signal.SIGINT)
        said = running.communicate(timeout=120)[0]
        assert running.returncode == 0, said
    finally:
        end(serving)
        end(running)


def check_mistakes(address):
    """Each is told at its place, in the interface file too."""
    folder = pathlib.Path(address.removeprefix("unix:")).parent
    (folder / "ball.idl").write_text("interface VS {\n    void start(strin name);\n};\n")
    (folder / "ball.yaml").write_text(pathlib.Path(DEPLOYMENT).read_text())
    done = subprocess.run([armature, "check", str(folder / "ball.yaml")], capture_output=True, text=True,
                          timeout=120)
    told = done.stdout + done.stderr
    assert done.returncode == 1, told
    assert "ball.idl:2:16: error: " in told, told
    assert told.count("ball.idl:2:16") == 1, told
    done = subprocess.run([armature, "check", DEPLOYMENT], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr


def check_models():
    """What a deployment has of an interface."""
    interface = str(pathlib.Path(DEPLOYMENT).parent / "ball.idl")
    done = subprocess.run([armature, "models", interface], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    for shown in ("VS: interface of ", "Chassis: interface of ", "void(float left [m/s], float right [m/s])",
                  "void(int32 x [px], int32 y [px])"):
        assert shown in done.stdout, done.stdout
    done = subprocess.run([armature, "models", interface + "#Chasis"], capture_output=True, text=True,
                          timeout=120)
    assert done.returncode == 1 and "did you mean 'Chassis'?" in done.stderr + done.stdout, done


with tempfile.TemporaryDirectory() as folder:
    address = f"unix:{folder}/robot.sock"
    check_pilot(address)
    check_deployment(address)
    check_mistakes(address)
    check_models()
