#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rover in two and in three processes, of which one is stopped or killed while it drives.

usage: processes_test.py PROGRAM LIBRARIES ROVER_DIR

Nothing here depends on how fast the machine is but that the rover gets under way at all: what is waited for has to come true in a long while. Times
to rest are those of the simulated faults (pilot_test.cpp, chassis_test.cpp); here it rests at all, and stays at rest.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import Process, kept_port, main_with_second_chances, wait_for

PROGRAM, LIBRARIES, ROVER = map(os.path.abspath, sys.argv[1:4])


class Rover(unittest.TestCase):
    SCHEME = "tcp"

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.robot_at, self.vision_at = (f"{self.SCHEME}://127.0.0.1:{self.enterContext(kept_port())}" for _ in range(2))

    def run_file(self, name, *overrides):
        sets = [word for one in overrides for word in ("--set", one)]
        process = Process([PROGRAM, "run", os.path.join(ROVER, "deployments", name), "-L", LIBRARIES, "--realtime", "off",
                           "--browse", *sets], cwd=self.folder)
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        process.kill(signal.SIGKILL) if process.process.poll() is None else None
        process.process.wait()
        process.process.stdin.close()
        process.process.stdout.close()

    # Far enough away that the rover drives for a while; and a machine that others use, too, may leave out samples, which is no fault of a wheel here.
    BALL = ("Ball.BeginX=2.0", "Ball.BeginY=0.3", "Chassis.Drive.max_missing=100")

    def start_robot(self):
        robot = self.run_file("robot.yaml", f"address={self.robot_at}", *self.BALL)
        robot.ask("1")
        return robot

    def start_three(self):
        chassis = self.run_file("chassis.yaml", f"address={self.robot_at}", *self.BALL)
        chassis.ask("1")
        return chassis, self.start_vision()

    def start_vision(self):
        vision = self.run_file("vision.yaml", f"address={self.vision_at}", f"chassis={self.robot_at}")
        vision.ask("1")
        return vision

    def start_pilot(self, vision=None):
        return self.run_file("pilot.yaml", f"chassis={self.robot_at}", f"vision={vision or self.robot_at}")

    def arm(self, robot):
        wait_for(lambda: robot.ask("pcall(function() return wait(Arming:arm()) end)").split() == ["true", "true"],
                 "it is armed; " + robot.text())

    def speed(self, robot):
        return max(abs(float(robot.ask(f"Chassis.Drive.Speed{side}"))) for side in ("Left", "Right"))

    def distance(self, robot):
        """From below the camera to the ball [m]."""
        return float(robot.ask("math.sqrt((Ball.Point.x - Rover.Place.x - 0.08 * math.cos(Rover.Place.heading))^2 + "
                               "(Ball.Point.y - Rover.Place.y - 0.08 * math.sin(Rover.Place.heading))^2)"))

    def wait_until_it_drives(self, robot):
        wait_for(lambda: self.speed(robot) > 0.1, "it drives; " + robot.text())

    def wait_until_it_rests(self, robot):
        wait_for(lambda: all(self.speed(robot) < 0.01 for _ in range(5)), "it rests; " + robot.text())

    def follow(self, robot, pilot):
        self.arm(robot)
        self.wait_until_it_drives(robot)
        wait_for(lambda: abs(self.distance(robot) - 1.0) < 0.03, "it is 1 m before the ball; " + pilot.text())
        self.assertGreater(float(robot.ask("Rover.Place.x")), 0.5)


class Processes(Rover):
    def test_two_processes_follow_the_ball(self):
        self.follow(self.start_robot(), self.start_pilot())

    def test_a_pilot_that_is_killed_leaves_the_chassis_at_rest_and_armed(self):
        robot = self.start_robot()
        pilot = self.start_pilot()
        self.arm(robot)
        self.wait_until_it_drives(robot)
        pilot.kill(signal.SIGKILL)
        self.wait_until_it_rests(robot)
        self.assertIn("was not renewed for 200 ms", robot.ask("Chassis.Drive.stop_reason"))
        self.assertEqual(robot.ask("Arming.armed"), "true")

    def test_a_pilot_that_is_stopped_leaves_the_chassis_at_rest(self):
        robot = self.start_robot()
        pilot = self.start_pilot()
        self.arm(robot)
        self.wait_until_it_drives(robot)
        pilot.kill(signal.SIGSTOP)
        self.wait_until_it_rests(robot)
        pilot.kill(signal.SIGCONT)

    def test_three_processes_go_on_from_rest_when_vision_comes_back(self):
        chassis, vision = self.start_three()
        pilot = self.start_pilot(self.vision_at)
        self.arm(chassis)
        self.wait_until_it_drives(chassis)
        vision.kill(signal.SIGKILL)
        self.wait_until_it_rests(chassis)
        self.start_vision()
        wait_for(lambda: float(chassis.ask("Rover.Place.x")) > 0.5, "it comes to the ball; " + pilot.text())

    def test_a_chassis_that_comes_back_is_not_armed(self):
        chassis, _ = self.start_three()
        pilot = self.start_pilot(self.vision_at)
        self.arm(chassis)
        self.wait_until_it_drives(chassis)
        chassis.kill(signal.SIGKILL)
        wait_for(lambda: "cannot be reached" in pilot.text() or "lost" in pilot.text(), "the pilot tells; " + pilot.text())
        again = self.run_file("chassis.yaml", f"address={self.robot_at}", *self.BALL)
        again.ask("wait(2)")
        self.assertEqual(again.ask("Arming.armed"), "false")
        self.assertLess(self.speed(again), 0.01)


def openssl(folder, *arguments):
    subprocess.run(["openssl", *arguments], cwd=folder, check=True, capture_output=True)


@unittest.skipUnless(shutil.which("openssl"), "there is no openssl")
class OverTls(Rover):
    """The same files with certificates: who has none of the right name commands nothing."""

    SCHEME = "tls"

    def setUp(self):
        super().setUp()
        key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc")
        openssl(self.folder, "req", "-x509", *key, "-keyout", "authority.key", "-out", "authority.pem", "-subj", "/CN=test")
        with open(os.path.join(self.folder, "ext"), "w", encoding="utf-8") as file:
            file.write("subjectAltName=IP:127.0.0.1\n")
        for name in ("robot", "vision", "pilot", "stranger"):
            openssl(self.folder, "req", *key, "-keyout", name + ".key", "-out", name + ".csr", "-subj", "/CN=" + name)
            openssl(self.folder, "x509", "-req", "-in", name + ".csr", "-CA", "authority.pem", "-CAkey", "authority.key",
                    "-CAcreateserial", "-extfile", "ext", "-out", name + ".pem")

    def run_file(self, name, *overrides, identity=None):
        own = identity or {"robot.yaml": "robot", "chassis.yaml": "robot", "vision.yaml": "vision", "pilot.yaml": "pilot"}[name]
        files = {"certificate": own + ".pem", "key": own + ".key", "authority": "authority.pem"}
        return super().run_file(name.replace(".yaml", "_tls.yaml"), *overrides,
                                *(f"{what}={os.path.join(self.folder, file)}" for what, file in files.items()))

    def test_two_processes_follow_the_ball(self):
        self.follow(self.start_robot(), self.start_pilot())

    def test_three_processes_follow_the_ball(self):
        chassis, _ = self.start_three()
        self.follow(chassis, self.start_pilot(self.vision_at))

    def test_a_stranger_with_a_good_certificate_moves_nothing(self):
        robot = self.start_robot()
        self.arm(robot)
        stranger = self.run_file("pilot.yaml", f"chassis={self.robot_at}", f"vision={self.robot_at}", identity="stranger")
        wait_for(lambda: stranger.ask("Chassis.PeerConnected") == "true", "it is connected; " + stranger.text())
        answer = stranger.ask("pcall(function() return wait(Chassis:setVelocity(0.3, 0.3)) end)")
        self.assertIn("stranger@tls may not command 'Chassis.Drive'", answer + stranger.text())
        self.assertLess(self.speed(robot), 0.01)
        for access in ("read 'Vision'", "command 'Vision'"):
            robot.wait_until_it_says(f"stranger@tls may not {access}")


if __name__ == "__main__":
    main_with_second_chances()
