#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Controller and plant as two processes, of which one is stopped or killed while the head moves.

usage: processes_test.py PROGRAM PLANT LIBRARIES JANUS_DIR

Nothing here depends on how fast the machine is but that a motion gets under way at all, which is
tried several times: what is waited for has to come true in a long while.
"""

import os
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import LONG, Process, states_in, wait_for

PROGRAM, PLANT, LIBRARIES, JANUS = sys.argv[1:5]
STILL = 2e-3  # rad; a joint at rest under friction and brake may creep so far
OFF = {"off", "watchdog", "started"}


def farthest(states):
    """By how much a joint moved in these states, at the most."""
    return max(max(position) - min(position) for position in zip(*(state["position"] for state in states)))


class Plant:
    """armature-janus-plant, and all its states."""

    def __init__(self, folder, *arguments):
        self.bus = os.path.join(folder, "bus")
        self.file = os.path.join(folder, "state")
        self.said = open(os.path.join(folder, "plant.log"), "a+", encoding="utf-8")
        self.process = subprocess.Popen([PLANT, "--bus", self.bus, "--state", self.file, *arguments],
                                        stderr=self.said)
        wait_for(lambda: os.path.exists(self.bus) and self.states(), "the plant is there")

    def states(self):
        return states_in(self.file)

    def now(self):
        return self.states()[-1]

    def after(self, seconds):
        """The states of so many seconds from now on, on the plant's clock."""
        begin = len(self.states())
        wait_for(lambda: (all_ := self.states())[-1]["time"] >= all_[begin - 1]["time"] + seconds,
                 f"{seconds} s pass")
        return self.states()[begin - 1:]

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
        code = self.process.wait(timeout=LONG)
        self.said.close()
        return code


class Controller(Process):
    """armature run FILE --browse, its operator this test."""

    def __init__(self, plant, folder, *arguments):
        deployment = os.path.join(folder, "controller.yaml")
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(f"include: [{JANUS}/deployments/on_can.yaml, {JANUS}/demo/recorder.yaml]\n")
        # A machine that is busy with other things may let a card wait for longer than a real one does.
        super().__init__(
            [PROGRAM, "run", deployment, "--set", f"bus=virtual:{plant.bus}", "--set",
             f"description={JANUS}/janus.urdf", "--set", "Cards.answer_timeout=8 ms", "--browse",
             "--statistics", "--out", os.path.join(folder, "out"), "-L", LIBRARIES, *arguments])

    def mend(self):
        """Until nothing is wrong any more; nothing is armed by that."""
        for _ in range(10):
            self.say("reset")
            self.say("start")
            self.ask("wait(0.2)")
            begin = len(self.lines)
            self.say("faults")
            self.ask("1")
            if any("all components run" in line for line in self.lines[begin:]):
                return
        raise AssertionError("it does not run again: " + self.text())

    def arm(self):
        """Where a sample was lost, the operator has looked."""
        for card in ("AIC1", "AIC2"):
            self.say(f"if not {card}.position_exact then {card}.position_confirmed = true end")
        return self.ask("pcall(function() return wait(Arming:arm()) end)").split() == ["true", "true"]


def whole_chunks(path):
    """How many chunks of an MCAP file are whole; a chunk says what its CRC is."""
    with open(path, "rb") as file:
        data = file.read()
    position, chunks = 8, 0
    while position + 9 <= len(data):
        kind, size = struct.unpack_from("<BQ", data, position)
        content = data[position + 9:position + 9 + size]
        if len(content) < size:
            break
        if kind == 6:
            crc, name = struct.unpack_from("<II", content, 24)
            records = content[32 + name + 8:]
            assert crc in (0, zlib.crc32(records))
            chunks += 1
        position += 9 + size
    return chunks


class Processes(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())
        self.plant = self.start_plant()

    def start_plant(self):
        plant = Plant(self.folder)
        self.addCleanup(plant.end)
        return plant

    def start_controller(self, *arguments):
        controller = Controller(self.plant, self.folder, *arguments)
        self.addCleanup(controller.end)
        return controller

    def let_move(self, controller):
        """The head is armed and in the middle of a motion."""
        for _ in range(10):
            if controller.arm():
                begin = self.plant.now()["position"]
                controller.say("Generator:moveTo(array(2.0, 2.0), 8)")
                try:
                    wait_for(lambda: self.plant.now()["state"] != ["on", "on"] or min(
                        now - then for now, then in zip(self.plant.now()["position"], begin)) > 0.2,
                        "it moves")
                except AssertionError as error:
                    raise AssertionError(f"{error}: {controller.text()}") from error
                if self.plant.now()["state"] == ["on", "on"]:
                    return
            controller.mend()
        self.fail("it never moves: " + controller.text())

    def assert_at_rest_and_off(self, seconds=1.0):
        states = self.plant.after(seconds)
        for state in states:
            self.assertLessEqual(set(state["state"]), OFF)
            self.assertEqual(state["brake_released"], [False, False])
            for joint in (0, 1):
                self.assertAlmostEqual(state["position"][joint], states[0]["position"][joint],
                                       delta=STILL)

    def wait_for_rest(self):
        wait_for(lambda: set(self.plant.now()["state"]) <= OFF, "both are off")
        # Joint 1 has no brake: friction stops it, the later the faster it was.
        wait_for(lambda: farthest(self.plant.after(0.5)) < STILL / 4, "friction has stopped it")

    def assert_moves_again_when_armed(self, controller):
        self.assertEqual(controller.ask("Arming.armed"), "false")
        self.let_move(controller)

    def test_a_killed_controller_stops_by_the_watchdogs_and_leaves_a_recording(self):
        controller = self.start_controller("--set", "Cards.guardian=off")
        self.let_move(controller)
        file = os.path.join(self.folder, "out", "janus.mcap")
        wait_for(lambda: os.path.exists(file) and whole_chunks(file) > 0, "a chunk is written")
        controller.process.kill()
        wait_for(lambda: self.plant.now()["state"] == ["watchdog", "watchdog"], "both watchdogs trip")
        self.assertEqual(self.plant.now()["brake_released"], [False, False])
        self.wait_for_rest()
        self.assert_at_rest_and_off()
        self.assertGreater(whole_chunks(file), 0)

        another = self.start_controller()
        wait_for(lambda: self.plant.now()["state"] == ["off", "off"], "the new host has the cards")
        another.say("Generator:moveTo(array(1.0, 1.0), 3)")
        self.assert_at_rest_and_off()
        self.assert_moves_again_when_armed(another)

    def test_a_killed_controller_has_its_cards_switched_off_by_its_guardian(self):
        controller = self.start_controller()
        self.let_move(controller)
        controller.process.kill()
        wait_for(lambda: "has died; switches the drives off" in controller.text(), "it is told")
        wait_for(lambda: "are idle" in controller.text(), "the guardian ends")
        self.assertEqual(self.plant.now()["brake_released"], [False, False])
        self.wait_for_rest()
        self.assert_at_rest_and_off()
        self.assertNotIn("watchdog", self.plant.now()["state"])

    def let_home(self, controller):
        """Its first joint is on its way to its switch, from where a motion has left it."""
        for _ in range(10):
            self.let_move(controller)
            controller.ask("Arming:disarm()")
            self.wait_for_rest()
            begin = self.plant.now()["position"][0]
            controller.say("Joint1:home()")
            try:
                wait_for(lambda: begin - self.plant.now()["position"][0] > 0.05, "it homes", 10.0)
                return
            except AssertionError:
                controller.mend()
        self.fail("it never homes: " + controller.text())

    def test_a_controller_that_is_killed_while_a_joint_homes_has_its_cards_switched_off(self):
        settings = {"Method": "switch", "Velocity": "-0.1", "Travel": "3 rad", "Effort": "4 V", "Stiffness": "60",
                    "Damping": "1"}
        controller = self.start_controller(*[word for name, value in settings.items()
                                             for word in ("--set", f"Joint1.Homing{name}={value}")])
        self.let_home(controller)
        controller.process.kill()
        wait_for(lambda: "are idle" in controller.text(), "the guardian ends")
        self.assertEqual(self.plant.now()["brake_released"], [False, False])
        self.wait_for_rest()
        self.assert_at_rest_and_off()

    def test_a_controller_that_was_stopped_faults_and_moves_nothing_when_it_goes_on(self):
        controller = self.start_controller()
        self.let_move(controller)
        controller.process.send_signal(signal.SIGSTOP)
        wait_for(lambda: set(self.plant.now()["state"]) <= OFF, "both are off")
        controller.process.send_signal(signal.SIGCONT)
        wait_for(lambda: "Cards: fault: its guardian has switched the drives off" in controller.text(),
                 "it finds out")
        self.wait_for_rest()
        self.assert_at_rest_and_off()
        self.assertEqual(controller.ask("Arming.armed"), "false")
        controller.mend()
        self.assert_at_rest_and_off()
        self.assert_moves_again_when_armed(controller)

    def test_a_controller_that_was_stopped_for_a_second_moves_nothing_when_it_goes_on(self):
        controller = self.start_controller("--set", "Cards.guardian=off")
        self.let_move(controller)
        controller.process.send_signal(signal.SIGSTOP)
        wait_for(lambda: self.plant.now()["state"] == ["watchdog", "watchdog"], "both watchdogs trip")
        self.wait_for_rest()
        controller.process.send_signal(signal.SIGCONT)
        self.assert_at_rest_and_off()
        self.assertEqual(controller.ask("Arming.armed"), "false")
        controller.say("faults")
        controller.ask("1")
        # Whichever thread is the first to look: at old data, or at the cards.
        self.assertRegex(controller.text(), "its data is older than declared|"
                         "AIC[12] +Exception  the card switched its actuator off")
        controller.mend()
        self.assert_at_rest_and_off()
        self.assert_moves_again_when_armed(controller)
        controller.end()
        skipped = re.search(r"thread Sampler: \d+ cycles run, (\d+) skipped", controller.text())
        self.assertIsNotNone(skipped, controller.text())
        self.assertGreater(int(skipped[1]), 50)

    def test_a_stopped_plant_is_silent_cards_by_name_and_moves_nothing_when_it_goes_on(self):
        controller = self.start_controller()
        self.let_move(controller)
        self.plant.process.send_signal(signal.SIGSTOP)
        wait_for(lambda: controller.ask("Arming.armed") == "false", "it is disarmed")
        controller.say("faults")
        controller.ask("1")
        self.assertRegex(controller.text(), "Sensor +Exception  .*Joint1")
        self.plant.process.send_signal(signal.SIGCONT)
        self.wait_for_rest()
        self.assert_at_rest_and_off()
        controller.mend()
        self.assert_at_rest_and_off()
        self.assert_moves_again_when_armed(controller)

    def test_a_killed_plant_is_no_bus_and_another_is_found_by_itself(self):
        controller = self.start_controller()
        self.let_move(controller)
        self.plant.process.kill()
        wait_for(lambda: controller.ask("Arming.armed") == "false", "it is disarmed")
        controller.say("faults")
        controller.ask("1")
        self.assertRegex(controller.text(), "AIC[12] +Exception  the bus of the card is gone")
        self.assertIn(f"the bus 'virtual:{self.plant.bus}' is down", controller.text())
        self.plant.process.wait()
        os.remove(self.plant.file)
        self.plant = self.start_plant()
        controller.mend()
        self.assert_at_rest_and_off()
        self.assert_moves_again_when_armed(controller)

    def test_a_controller_with_a_wrong_bit_rate_is_bus_off_and_moves_nothing(self):
        controller = self.start_controller("--set", "bit_rate=500000")
        self.assertFalse(controller.arm())
        wait_for(lambda: f"the bus 'virtual:{self.plant.bus}' is bus-off" in controller.text(),
                 "it is named: " + controller.text())
        controller.say("Generator:moveTo(array(1.0, 1.0), 3)")
        for state in self.plant.after(1.0):
            self.assertNotIn("on", state["state"])
            self.assertAlmostEqual(state["position"][0], 0.0, delta=STILL)
            self.assertAlmostEqual(state["position"][1], 0.0, delta=STILL)

    def test_hostile_processes_on_the_bus_do_not_stop_a_motion(self):
        controller = self.start_controller()
        self.let_move(controller)
        for size in (1, 7, 32, 44, 5000):
            for _ in range(50):
                with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as stranger:
                    try:
                        stranger.connect(self.plant.bus)
                        stranger.send(os.urandom(size))
                    except (BrokenPipeError, ConnectionError, BlockingIOError):
                        pass
        goal = self.plant.now()["position"][0] + 0.2
        wait_for(lambda: self.plant.now()["position"][0] > goal, "it moves on: " + controller.text())

    def test_the_plant_ends_in_order_and_its_host_says_so(self):
        self.plant.process.terminate()
        self.assertEqual(self.plant.process.wait(timeout=LONG), 0)
        self.assertFalse(os.path.exists(self.plant.bus))
        controller = self.start_controller()
        self.assertEqual(controller.process.wait(timeout=LONG), 1)
        controller.end()
        self.assertIn("no process serves there", controller.text())
        self.assertIn("start what has the bus first: armature-janus-plant", controller.text())

    def test_wrong_use_of_the_plant_says_what_is_wrong(self):
        for arguments, code, says in (
                ((), 2, "--bus"), (("--bus", "x", "--can", "can0"), 2, "bus"),
                (("--bus", self.plant.bus), 1, "another process serves there"),
                (("--can", "no_such0"), 1, "no_such0"),
                (("--bus", os.path.join(self.folder, "b"), "--urdf", "/nowhere"), 1, "/nowhere")):
            done = subprocess.run([PLANT, *arguments], capture_output=True, text=True, timeout=LONG)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(says, done.stderr + done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
