#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot's side of the rover in a bundle for a board, under emulation, commanded by the control program on this machine.

usage: board_test.py PROGRAM LIBRARIES ROVER_DIR EMULATOR SYSTEM BUNDLE

The emulated board is slower than the robot's time, so that the ball is not followed well: what is waited for is that it is seen there, that the
pilot here commands what follows of it, and that the wheels there turn and rest.
"""

import os
import signal
import sys
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import Broken, Process, kept_port, wait_for

PROGRAM, LIBRARIES, ROVER = map(os.path.abspath, sys.argv[1:4])
EMULATOR, SYSTEM, BUNDLE = sys.argv[4], os.path.abspath(sys.argv[5]), Path(sys.argv[6]).resolve()
LONG = 120.0
STARTS = 10
# Far enough away that the rover drives for a while.
BALL = ["--set", "Ball.BeginX=2.0", "--set", "Ball.BeginY=0.3"]


def speed(robot):
    return max(abs(float(robot.ask(f"Chassis.Drive.Speed{side}"))) for side in ("Left", "Right"))


def is_armed(robot):
    return robot.ask("pcall(function() return wait(Arming:arm()) end)").split() == ["true", "true"]


def armed_robot(at):
    """The first cycles come too late, since the emulator translates them, and that is a fault of the chassis: it is reset and started as by
    an operator, until it arms."""
    [deployment] = (BUNDLE / "deployment").rglob("robot.yaml")
    robot = Process([EMULATOR, "-L", SYSTEM, str(BUNDLE / "bin/armature"), "run", str(deployment), "--realtime", "off", "--browse",
                     "--set", f"address={at}", *BALL])
    for _ in range(STARTS):
        try:
            wait_for(lambda: is_armed(robot), "it is armed", 10.0)
            return robot
        except Broken:
            robot.say("reset")
            robot.say("start")
    said = robot.text()
    end(robot)
    raise Broken("the robot does not arm:\n" + said)


def end(process):
    if process.process.poll() is None:
        process.kill(signal.SIGKILL)
    process.process.wait()


def drive(at):
    robot = armed_robot(at)
    pilot = Process([PROGRAM, "run", os.path.join(ROVER, "deployments/pilot.yaml"), "-L", LIBRARIES, "--realtime", "off", "--browse",
                     "--set", f"chassis={at}", "--set", f"vision={at}"])
    try:
        wait_for(lambda: robot.ask("Vision.Seen") == "true", "the ball is seen on the board", LONG)
        wait_for(lambda: float(pilot.ask("X.Out")) != 0.0, "its position comes to the pilot", LONG)
        wait_for(lambda: speed(robot) > 0.1, "the board's wheels turn", LONG)
        pilot.kill(signal.SIGKILL)
        wait_for(lambda: all(speed(robot) < 0.01 for _ in range(3)), "they rest without the pilot", LONG)
        print(f"the rover at x = {float(robot.ask('Rover.Place.x')):.2f} m")
    except Broken:
        print("\n".join(line for one in (robot, pilot) for line in one.lines[-30:]))
        raise
    finally:
        end(robot)
        end(pilot)


with kept_port() as number:
    drive(f"tcp://127.0.0.1:{number}")
