#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Short runs of Janus, the WAM and the rover, recorded and replayed with `armature replay`.

usage: replay_test.py PROGRAM ROBOTS_FOLDER LIBRARY_FOLDER
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM, ROBOTS, LIBRARIES = sys.argv[1:4]
EQUAL = re.compile(r"equal to the bit: (\d+) samples of (\d+) ports and properties\n")

# What a person would do: arms, moves, and sets a property on the way.
JANUS = """
wait(0.1)
assert(wait(Arming:arm()))
local motion = Generator:moveTo(array(0.5, 0.3), 1)
wait(0.5)
PID1.Kp = 410
assert(wait(motion))
wait(0.2)
stop()
"""
# Somebody switches a motor off while its joint moves.
SWITCHED_OFF = """
wait(0.1)
assert(wait(Arming:arm()))
local motion = Generator:moveTo(array(0.5, 0.3), 1)
wait(0.3)
Cards:commandCard(1, 2)
wait(2)
stop()
"""
WAM_ESTOP = """
wait(1)
assert(wait(Arming:arm()))
Generator:moveTo(array(0.3, -0.5, 0.2, 1.5, 0.0, 0.2, 0.0), 2)
wait(0.6)
WAM:estop()
wait(0.5)
stop()
"""
ROVER = """
wait(0.1)
assert(wait(Arming:arm()))
Phase.Value = 1
wait(0.5)
Rover:put(Rover.Place.x, Rover.Place.y, Rover.Place.heading + 0.3)
wait(1)
stop()
"""
TEACH = """
wait(1.5)
assert(wait(Arming:arm()))
assert(wait(Generator:moveTo(array(0.1, -1.9, 0.1, 3.0, 0.0, 0.1, 0.0), 1)))
assert(wait(Teacher:keepPose("here")))
assert(wait(Teacher:goTo("here", 0)))
stop()
"""
GO_THERE = """
wait(1.5)
assert(wait(Arming:arm()))
wait(0.2)
assert(wait(Teacher:goTo("here", 0)))
stop()
"""
# The encoder of a wheel falls silent while the rover turns.
ROVER_SILENT = """
wait(0.1)
assert(wait(Arming:arm()))
wait(0.5)
Rover:put(Rover.Place.x, Rover.Place.y, Rover.Place.heading + 0.3)
wait(0.3)
Rover.SilentEncoder = 1
wait(1)
stop()
"""


def armature(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120,
                          stdin=subprocess.DEVNULL, **options)


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def store(path, content):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(content, file)


def change_acts(folder, function):
    """Of the acts of a run; the function changes their list."""
    with open(f"{folder}/acts.jsonl", encoding="utf-8") as file:
        acts = [json.loads(line) for line in file]
    function(acts)
    with open(f"{folder}/acts.jsonl", "w", encoding="utf-8") as file:
        file.writelines(json.dumps(act) + "\n" for act in acts)


def files_in(folder):
    """Paths and contents of all files."""
    found = {}
    for place, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(place, name), "rb") as file:
                found[os.path.join(place, name)] = file.read()
    return found


def change(path, what, by):
    """Of a text; it has to have what is changed."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    assert what in text, f"{path} has no {what}"
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(what, by))


def records_of(mcap, begin, end):
    """(kind, begin of the content, end of it) of each record of an MCAP file."""
    place = begin
    while place < end:
        length = struct.unpack_from("<Q", mcap, place + 1)[0]
        yield mcap[place], place + 9, place + 9 + length
        place += 9 + length


def mutate(path, channel):
    """Changes a digit of a number of the channel, in the middle of the recording, and mends the
    checksums. Returns the time [ns] and number of the sample, and the value as it is now."""
    with open(path, "rb") as file:
        mcap = bytearray(file.read())
    begin, end = 8, len(mcap) - 8
    chunks = [(a, b) for kind, a, b in records_of(mcap, begin, end) if kind == 0x06]
    ids = {}
    found = []
    for a, b in chunks:
        size = struct.unpack_from("<I", mcap, a + 28)[0]  # of the name of the compression
        inner = a + 28 + 4 + size + 8
        for kind, c, d in records_of(mcap, inner, b):
            if kind == 0x04:
                number, _, length = struct.unpack_from("<HHI", mcap, c)
                ids[number] = mcap[c + 8:c + 8 + length].decode()
            if kind == 0x05 and ids.get(struct.unpack_from("<H", mcap, c)[0]) == channel:
                found.append((a, inner, b, c, d))
    for kind, c, d in records_of(mcap, begin, end):
        if kind == 0x04:
            number, _, length = struct.unpack_from("<HHI", mcap, c)
            ids[number] = mcap[c + 8:c + 8 + length].decode()
    if not found:  # channels stand before the chunks
        for a, b in chunks:
            size = struct.unpack_from("<I", mcap, a + 28)[0]
            inner = a + 28 + 4 + size + 8
            for kind, c, d in records_of(mcap, inner, b):
                if kind == 0x05 and ids.get(struct.unpack_from("<H", mcap, c)[0]) == channel:
                    found.append((a, inner, b, c, d))
    a, inner, b, c, d = found[len(found) // 2]
    sequence, time_ns = struct.unpack_from("<IQ", mcap, c + 2)
    text = mcap[c + 22:d]
    digit = max(i for i, byte in enumerate(text) if chr(byte).isdigit())
    mcap[c + 22 + digit] = ord("1") if text[digit] != ord("1") else ord("2")
    struct.pack_into("<I", mcap, a + 24, zlib.crc32(mcap[inner:b]))
    for kind, c2, _ in records_of(mcap, begin, end):
        if kind == 0x0F and struct.unpack_from("<I", mcap, c2)[0] != 0:
            struct.pack_into("<I", mcap, c2, zlib.crc32(mcap[:c2 - 9]))
    with open(path, "wb") as file:
        file.write(mcap)
    return time_ns, sequence, mcap[c + 22:d].decode()


def load_samples(path, channel):
    """Values of a channel of a recording whose chunks are not compressed, as they are written."""
    with open(path, "rb") as file:
        mcap = file.read()
    ids, values = {}, []
    inside = [(a + 40 + struct.unpack_from("<I", mcap, a + 28)[0], b)
              for kind, a, b in records_of(mcap, 8, len(mcap) - 8) if kind == 0x06]
    for begin, end in inside + [(8, len(mcap) - 8)]:
        for kind, a, _ in records_of(mcap, begin, end):
            if kind == 0x04:
                number, _, length = struct.unpack_from("<HHI", mcap, a)
                ids[number] = mcap[a + 8:a + 8 + length].decode()
    for begin, end in inside:
        for kind, a, b in records_of(mcap, begin, end):
            if kind == 0x05 and ids[struct.unpack_from("<H", mcap, a)[0]] == channel:
                values.append(mcap[a + 22:b].decode())
    return values


class Recorded(unittest.TestCase):
    """A run of a robot; each test has its own copy."""

    kept = {}

    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.root)

    def run_of(self, deployment, script, name, *arguments, code=0, timed=("--sim",), **options):
        folder = f"{self.root}/{name}"
        if not os.path.exists(folder):
            with open(f"{self.root}/{name}.lua", "w", encoding="utf-8") as file:
                file.write(script)
            done = armature("run", f"{ROBOTS}/{deployment}", "-L", LIBRARIES, *timed, "--script",
                            f"{self.root}/{name}.lua", "--out", folder, *arguments, **options)
            if code is not None:
                self.assertEqual(done.returncode, code, done.stderr)
        copy = tempfile.mkdtemp(prefix=f"{name}_of_{self.id().split('.')[-1]}_", dir=self.root)
        shutil.copytree(folder, copy, dirs_exist_ok=True)
        return copy

    def replay(self, folder, *arguments, code=0):
        done = armature("replay", folder, "-L", LIBRARIES, *arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def expect_equal(self, folder, least):
        text = self.replay(folder).stdout
        self.assertRegex(text, EQUAL)
        self.assertGreater(int(EQUAL.match(text).group(1)), least)


class Janus(Recorded):
    def recorded(self):
        return self.run_of("janus/demo/pid.yaml", JANUS, "janus")

    def test_is_equal_to_the_bit(self):
        folder = self.recorded()
        with open(f"{folder}/acts.jsonl", encoding="utf-8") as file:
            acts = [json.loads(line) for line in file]
        self.assertEqual([act["act"] for act in acts],
                         ["begin", "begin", "set", "before_stop", "end"])
        self.expect_equal(folder, 1000)

    def test_a_replay_can_be_replayed_from_another_folder_and_without_its_script(self):
        folder = self.recorded()
        os.remove(f"{self.root}/janus.lua")
        done = armature("replay", os.path.basename(folder), "-L", LIBRARIES, cwd=self.root)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_changed_sample_is_the_first_difference(self):
        folder = self.recorded()
        time_ns, sequence, value = mutate(f"{folder}/janus.mcap", "PID1.Out")
        told = self.replay(folder, code=5).stdout
        self.assertIn(f"sample {sequence} of component PID1, port Out", told)
        self.assertIn(f"was {value}", told)
        self.assertIn(f"first difference at {time_ns // 1000000} ms", told.replace("1 s", "1000 ms"))
        before = f"{(time_ns - 20_000_000) / 1e9} s"
        self.assertRegex(self.replay(folder, "--until", before).stdout, EQUAL)

    def test_what_is_upstream_is_told(self):
        folder = self.recorded()
        change(f"{folder}/experiment.json", '"set": []', '"set": ["PID1.Ki=21"]')
        told = self.replay(folder, code=5)
        self.assertIn("of component PID1, port Out", told.stdout)
        self.assertIn("the deployment is not what it was: component PID1: '  double Ki = 20' was "
                      "recorded, '  double Ki = 21' is here", told.stderr)

    def test_what_if_has_both_on_one_page(self):
        folder = self.recorded()
        told = self.replay(folder, "--set", "PID1.Kp=200", "--set", "PID2.Kp=200").stdout
        self.assertIn(f"{folder}/what-if/report.html", told)
        figures = load(f"{folder}/what-if/report.json")["controllers"]
        self.assertEqual(sorted(figures), ["was", "what-if"])
        was, is_now = (figures[name]["joints"][0]["iae"] for name in ("was", "what-if"))
        self.assertGreater(is_now, 1.01 * was)
        with open(f"{folder}/what-if/report.html", encoding="utf-8") as page:
            self.assertIn('"what_if":{"changes":["PID1.Kp=200","PID2.Kp=200"]}', page.read())

    def test_what_if_with_a_file(self):
        folder = self.recorded()
        with open(f"{folder}/other.yaml", "w", encoding="utf-8") as file:
            file.write("components:\n  PID{1..2}: {override: true, properties: {Kp: 300}}\n")
        self.replay(folder, "--with", f"{folder}/other.yaml", "-o", f"{folder}/other")
        experiment = load(f"{folder}/other/report.json")["controllers"]
        self.assertNotEqual(experiment["was"], experiment["what-if"])

    def test_steps_and_breaks_are_lines(self):
        folder = self.recorded()
        told = self.replay(folder, "--break", "Joint1.Position > 0.2", "--break",
                           "PID1.Kp == 410").stdout.splitlines()
        breaks = [line for line in told if line.startswith("break at ")]
        self.assertEqual(len(breaks), 2, told)
        self.assertTrue(any("Joint1.Position = 0.20" in line for line in breaks), breaks)
        steps = self.replay(folder, "--step", "--until", "0.2s").stdout.splitlines()
        self.assertTrue(any(re.match(r"50 ms  .*Sampler.SamplePort = 5\b", line) for line in steps), steps)
        wrong = self.replay(folder, "--break", "Joint1.Positon > 1", code=1).stderr
        self.assertIn("did you mean 'Position'?", wrong)

    def test_a_fault_is_replayed_with_its_black_box(self):
        folder = self.run_of("janus/demo/pid.yaml", SWITCHED_OFF, "switched_off", code=1)
        boxes = [name for name in os.listdir(folder) if name.startswith("blackbox-")]
        self.assertTrue(boxes)
        self.expect_equal(folder, 1000)
        mutate(f"{folder}/{boxes[0]}", "PID1.Out")
        self.assertIn("of component PID1, port Out", self.replay(folder, code=5).stdout)

    def test_dropped_samples_are_not_equal(self):
        folder = self.recorded()
        summary = load(f"{folder}/run.json")
        summary["counters"]["Reporter.dropped"] = {"value": 3, "doc": ""}
        with open(f"{folder}/run.json", "w", encoding="utf-8") as file:
            json.dump(summary, file)
        self.assertIn("3 samples are missing in the recording", self.replay(folder, code=6).stdout)

    def test_a_changed_library_is_told(self):
        folder = self.recorded()
        experiment = load(f"{folder}/experiment.json")
        for library in experiment["libraries"]:
            library["hash"] = "0" * 16
        with open(f"{folder}/experiment.json", "w", encoding="utf-8") as file:
            json.dump(experiment, file)
        told = self.replay(folder)
        self.assertIn("component library 'janus'", told.stderr)
        self.assertIn("is not the one that was recorded", told.stderr)

    def test_a_missing_port_is_named(self):
        folder = self.recorded()
        experiment = load(f"{folder}/experiment.json")
        for path, text in experiment["texts"].items():
            experiment["texts"][path] = text.replace('"PID*.Ref", ', "")
        with open(f"{folder}/experiment.json", "w", encoding="utf-8") as file:
            json.dump(experiment, file)
        self.assertIn("'PID1.Ref' was recorded, but is not recorded now",
                      self.replay(folder, code=1).stderr)

    def test_a_file_that_is_gone_is_kept_in_the_experiment(self):
        folder = self.recorded()
        change(f"{folder}/experiment.json", "janus.urdf", "gone.urdf")
        self.assertIn("is not what it was when the run was recorded", self.replay(folder).stderr)

    def test_an_act_puts_nobody_on_a_bus_of_another_process(self):
        folder = self.run_of("wam/demo/npid.yaml", WAM_ESTOP, "wam", code=1)
        change_acts(folder, lambda acts: acts.insert(
            1, {"time_ns": 1, "turn": 0, "act": "set", "component": "WAM", "item": "bus",
                "values": ['{"value":"virtual:/tmp/nobody"}']}))
        told = self.replay(folder, code=5).stdout
        self.assertIn("it is refused: a replay uses no bus of another process", told)

    def test_wrong_folders_are_refused(self):
        self.assertIn("is no folder", self.replay(f"{self.root}/nowhere", code=1).stderr)
        empty = tempfile.mkdtemp(dir=self.root)
        self.assertIn("has no experiment.json", self.replay(empty, code=1).stderr)
        folder = self.recorded()
        self.assertIn("has files that no replay has made",
                      self.replay(folder, "-o", os.path.dirname(PROGRAM), code=1).stderr)
        os.remove(f"{folder}/janus.mcap")
        self.assertIn("has no recording", self.replay(folder, code=1).stderr)


    def test_an_act_that_was_refused_and_is_done_is_a_difference(self):
        folder = self.recorded()
        change_acts(folder, lambda acts: acts.insert(3, {"refused": 3, "why": "it was late"}))
        told = self.replay(folder, code=5).stdout
        self.assertIn("was set of 'PID1.Kp': it is refused: it was late", told)
        self.assertIn("is  set of 'PID1.Kp': it is done", told)
        told = self.replay(folder, "--set", "PID2.Kp=200").stderr
        self.assertIn("set of 'PID1.Kp': it is done; when it was recorded, it is refused", told)

    def test_an_act_that_was_done_and_is_refused_is_a_difference(self):
        folder = self.recorded()
        change_acts(folder, lambda acts: acts[2].update(item="Gain"))
        self.assertIn("is  set of 'PID1.Gain': it is refused", self.replay(folder, code=5).stdout)

    def test_an_act_without_its_values_is_refused(self):
        folder = self.recorded()

        def of_a_command(acts):
            acts[2] = {**acts[2], "component": "Arming", "item": "stop", "values": []}

        change_acts(folder, of_a_command)
        self.assertIn("has no value to set", self.replay(folder, code=5).stdout)

    def test_a_refused_act_is_refused_again(self):
        script = JANUS.replace("PID1.Kp = 410", "pcall(function() PID1.Kp = \"much\" end)\n"
                               "pcall(function() Generator:moveTo(array(0.5), 1) end)")
        folder = self.run_of("janus/demo/pid.yaml", script, "refused")
        self.expect_equal(folder, 1000)

    def test_an_act_whose_turn_does_not_come_is_told_and_a_what_if_goes_by_time(self):
        folder = self.recorded()
        change_acts(folder, lambda acts: acts[2].update(attended=True, turn=10**9))
        self.assertIn("does not come by the turn", self.replay(folder, code=5).stdout)
        told = self.replay(folder, "--set", "PID2.Kp=200").stderr
        self.assertNotIn("does not come by the turn", told)
        _, now = (load(f"{folder}/what-if/report.json")["controllers"][name]["joints"][0]["iae"]
                  for name in ("was", "what-if"))
        change_acts(folder, lambda acts: acts.pop(2))
        self.replay(folder, "--set", "PID2.Kp=200")
        without = load(f"{folder}/what-if/report.json")["controllers"]["what-if"]["joints"][0]["iae"]
        self.assertNotEqual(now, without)

    def test_it_ends_whatever_the_acts_say(self):
        folder = self.recorded()
        change_acts(folder, lambda acts: acts[-1].update(time_ns=9 * 10**18))
        told = self.replay(folder, code=5)
        self.assertIn("later than a minute after that is left out", told.stderr)

    def test_another_end_is_a_difference(self):
        folder = self.recorded()
        summary = load(f"{folder}/run.json")
        store(f"{folder}/run.json", {**summary, "faults": 2})
        told = self.replay(folder, code=5).stdout
        self.assertIn("was faults: 2", told)
        self.assertIn("is  faults: 0", told)

    def test_a_summary_of_another_kind_is_no_crash(self):
        folder = self.recorded()
        summary = load(f"{folder}/run.json")
        summary["counters"]["Reporter.dropped"] = {"value": "many"}
        store(f"{folder}/run.json", summary)
        self.assertRegex(self.replay(folder).stdout, EQUAL)

    def test_a_place_above_the_run_is_refused(self):
        place = tempfile.mkdtemp(dir=self.root)
        store(f"{place}/replay.json", {})
        shutil.move(self.recorded(), f"{place}/run")
        os.symlink(place, f"{self.root}/link_to_place")
        before = files_in(place)
        for out in (place, f"{self.root}/link_to_place", f"{place}/run"):
            told = self.replay(f"{place}/run", "-o", out, code=1).stderr
            self.assertIn("has the recorded run in it", told)
        self.assertEqual(files_in(place), before)

    def test_code_from_the_folder_of_the_run_is_not_run(self):
        folder = self.recorded()
        evil = f"{folder}/evil"
        os.mkdir(evil)
        with open(f"{evil}/libevil.so", "w", encoding="utf-8") as file:
            file.write("no library")
        experiment = load(f"{folder}/experiment.json")
        deployment = experiment["deployment"]
        experiment["texts"][deployment] += "\nlibraries: [evil]\n"
        experiment.update(folder=folder, library_folders=["evil"])
        store(f"{folder}/experiment.json", experiment)
        told = self.replay(folder, code=1).stderr
        self.assertIn("name its folder with -L; the run had -L evil", told)
        self.assertIn("cannot load the library", self.replay(folder, "-L", evil, code=1).stderr)
        experiment["texts"]["evil/run.yaml"] = experiment["texts"].pop(deployment)
        store(f"{folder}/experiment.json", {**experiment, "deployment": "evil/run.yaml"})
        told = self.replay(folder, code=1).stderr
        self.assertIn("would be 'evil/libevil.so', which the folder of the run alone says", told)

    def test_a_folder_that_is_gone_is_an_error(self):
        folder = self.recorded()
        experiment = load(f"{folder}/experiment.json")
        store(f"{folder}/experiment.json", {**experiment, "folder": "/nowhere/at/all"})
        self.assertIn("where its relative paths begin", self.replay(folder, code=1).stderr)

    def test_what_speaks_to_the_outside_is_refused(self):
        folder = self.recorded()
        if not any(name.startswith("libros2") for name in os.listdir(LIBRARIES)):
            self.skipTest("the library ros2 is not built")
        with open(f"{folder}/ros.yaml", "w", encoding="utf-8") as file:
            file.write("libraries: [ros2]\ncomponents:\n  Ros: {model: RosNode, activity: "
                       "{periodic: 50 ms, scheduler: other}}\n")
        told = self.replay(folder, "--with", f"{folder}/ros.yaml", code=1).stderr
        self.assertIn("'Ros' (RosNode) speaks to others outside of this process", told)



class Alone(Recorded):
    """Components that run again without the others, on what was recorded."""

    WARNING = "what is not recorded does not come again: the event Arming.Arm"

    def recorded(self, *arguments):
        return self.run_of("janus/demo/pid.yaml", JANUS, "janus" + "".join(arguments[1::2]), *arguments)

    def in_real_time(self):
        """A wave and its filter, which every machine keeps up with."""
        if not os.path.exists(f"{self.root}/wave.yaml"):
            store(f"{self.root}/wave.yaml", {
                "include": [f"{ROBOTS}/../examples/02_ports_and_triggers/wave.yaml"],
                "libraries": ["record"],
                "components": {"Reporter": {
                    "model": "Reporter", "activity": {"periodic": "50 ms", "scheduler": "other"},
                    "properties": {"what": ["Source", "Filter"], "file": "wave.mcap"}}}})
        return self.run_of(os.path.relpath(f"{self.root}/wave.yaml", ROBOTS),
                           "wait(0.6)\nstop()\n", "wave", timed=())

    def kept_up(self, folder, channel):
        """A robot's run in real time, on a machine that may be too slow for it."""
        recording = next(name for name in os.listdir(folder) if name.endswith(".mcap"))
        if not load_samples(f"{folder}/{recording}", channel):
            self.skipTest("this build is too slow on this machine to run the robot in real time")

    def test_are_equal_to_the_bit(self):
        told = self.replay(self.recorded(), "--only", "PID*")
        self.assertRegex(told.stdout, EQUAL)
        self.assertIn(self.WARNING, told.stderr)

    def test_are_equal_to_the_bit_after_a_run_in_real_time(self):
        folder = self.in_real_time()
        told = self.replay(folder, code=1).stderr
        self.assertIn("was recorded in real time, whose hardware is not here: name the components "
                      "that are to run again on what was recorded (--only 'Controller,PID*')", told)
        for names in ("Filter", "Source,Filter", "Source"):
            told = self.replay(folder, "--only", names).stdout
            self.assertRegex(told, EQUAL)
            self.assertGreater(int(EQUAL.match(told).group(1)), 20)

    def test_of_the_head_are_equal_to_the_bit_after_a_run_in_real_time(self):
        folder = self.run_of("janus/demo/pid.yaml", JANUS, "real", code=None, timed=())
        self.kept_up(folder, "PID1.Out")
        self.assertRegex(self.replay(folder, "--only", "PID*").stdout, EQUAL)

    def test_differ_if_what_was_recorded_is_changed(self):
        folder = self.recorded()
        mutate(f"{folder}/janus.mcap", "PID1.Sen")
        self.assertIn("of component PID1, port Out", self.replay(folder, "--only", "PID1", code=5).stdout)
        folder = self.in_real_time()
        mutate(f"{folder}/wave.mcap", "Filter.Filtered")
        told = self.replay(folder, "--only", "Filter", code=5).stdout
        self.assertIn("of component Filter, port Filtered", told)
        self.assertIn("samples differ; in real time what another thread wrote may come a cycle", told)

    def test_answer_what_if_on_what_was_recorded(self):
        folder = self.in_real_time()
        told = self.replay(folder, "--only", "Filter", "--set", "Filter.Weight=0.5").stdout
        self.assertIn(f"{folder}/what-if/report.html", told)
        was = load_samples(f"{folder}/what-if/was/wave.mcap", "Filter.Filtered")
        what_if = load_samples(f"{folder}/what-if/what-if/wave.mcap", "Filter.Filtered")
        self.assertEqual(len(was), len(what_if))
        self.assertNotEqual(was, what_if)
        self.assertEqual(load(f"{folder}/what-if/what_if.json")["only"], ["Filter"])

    def test_need_what_others_wrote(self):
        told = self.replay(self.recorded(), "--only", "Sensor", code=1).stderr
        self.assertIn("'Joint1.Displacement', which goes to 'Sensor.Displacement1', is not recorded, "
                      "likewise 'Joint2.Displacement' (have a Reporter record it (what: "
                      "[Joint1.Displacement]), or let 'Joint1' run again, too)", told)
        told = self.replay(self.recorded("--set", "Reporter.every=2"), "--only", "PID1", code=1).stderr
        self.assertIn("is recorded with gaps (record it all the time, without 'every' and "
                      "'on_change'", told)

    def test_call_nobody_who_does_not_run(self):
        told = self.replay(self.recorded(), "--only", "Joint1", code=1).stderr
        self.assertIn("'Joint1' calls 'Arming', whose answers are not recorded: notArmed", told)

    def test_have_names_and_something_to_compare(self):
        told = self.replay(self.recorded(), "--only", "PID3", code=1).stderr
        self.assertIn("there is no component 'PID3' that could run again (did you mean 'PID1'?)", told)
        told = self.replay(self.recorded(), "--only", "Controller", code=1).stderr
        self.assertIn("nothing is recorded of what Controller wrote, so nothing can be compared", told)

    def test_are_not_on_a_bus_of_another_process(self):
        folder = self.recorded()
        change(f"{folder}/experiment.json", "SimulatedJanus", "AICBus")
        change(f"{folder}/experiment.json", 'supply: 12 V, robot_description: \\"${description}\\"}',
               "bus: 'virtual:/tmp/nobody'}")
        told = self.replay(folder, "--only", "Cards", code=1).stderr
        self.assertIn("'Cards' is on the bus 'virtual:/tmp/nobody' of another process", told)

        told = self.replay(self.recorded("--set", "Reporter.what=[Sensor.sensor, PID1.Kp, PID1.Ref, "
                                         "PID1.Sen]"), "--only", "PID1", code=1).stderr
        self.assertIn("nothing is recorded of what PID1 wrote", told)

    def test_go_over_to_another_mode(self):
        store(f"{self.root}/modes.yaml", {
            "include": [f"{ROBOTS}/janus/deployments/modes.yaml"], "libraries": ["record"],
            "grants": {"script": ["Arming.arm"]},
            "components": {"Reporter": {
                "model": "Reporter", "activity": {"periodic": "50 ms", "scheduler": "other"},
                "properties": {"what": ["*.*"], "file": "modes.mcap", "buffer": 5000}}}})
        folder = self.run_of(os.path.relpath(f"{self.root}/modes.yaml", ROBOTS), JANUS.replace("PID1.Kp = 410", 'Modes:switch("feed_forward")'), "modes")
        told = self.replay(folder, "--only", "Sampler,Controller*,Model,PID*,Modes").stdout
        self.assertRegex(told, EQUAL)

    def test_are_given_what_recorders_of_the_run_wrote(self):
        folder = self.recorded()
        shutil.copy(f"{folder}/janus.mcap", f"{folder}/another.mcap")
        mutate(f"{folder}/another.mcap", "PID1.Sen")
        self.assertRegex(self.replay(folder, "--only", "PID*").stdout, EQUAL)

    def test_of_a_robot_of_another_process(self):
        bus = f"{self.root}/head.bus"
        store(f"{self.root}/on_can.yaml", {
            "include": [f"{ROBOTS}/janus/deployments/on_can.yaml"], "libraries": ["record"],
            "grants": {"script": ["Arming.arm"]}, "parameters": {"bus": f"virtual:{bus}"},
            "components": {"Reporter": {
                "model": "Reporter", "activity": {"periodic": "50 ms", "scheduler": "other"},
                "properties": {"what": ["PID*.Ref", "PID*.Sen", "PID*", "Generator", "Joint*.Armed", "BridgeRef"],
                               "file": "head.mcap"}}}})
        head = subprocess.Popen([f"{os.path.dirname(PROGRAM)}/armature-janus-plant", "--bus", bus],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            for _ in range(100):
                if os.path.exists(bus):
                    break
                time.sleep(0.05)
            with open(f"{self.root}/move.lua", "w", encoding="utf-8") as file:
                file.write(JANUS)
            folder = f"{self.root}/head"
            armature("run", f"{self.root}/on_can.yaml", "-L", LIBRARIES, "--script",
                     f"{self.root}/move.lua", "--out", folder)
        finally:
            head.kill()
            head.wait()
        self.kept_up(folder, "PID1.Out")
        for names in ("PID*", "Generator,Arming"):
            told = self.replay(folder, "--only", names).stdout
            self.assertRegex(told, EQUAL)
            self.assertGreater(int(EQUAL.match(told).group(1)), 20)
        self.assertIn("'Cards' is on the bus", self.replay(folder, "--only", "Cards", code=1).stderr)

    def test_of_the_wam(self):
        folder = self.run_of("wam/demo/computed_torque.yaml", WAM_ESTOP, "wam_alone", "--set",
                             "Reporter.what=[Controller, Sensor, BridgeRef, Sampler]", code=None)
        self.assertRegex(self.replay(folder, "--only", "Sampler,Controller").stdout, EQUAL)


class Wam(Recorded):
    def test_a_replay_leaves_the_files_of_the_robot_alone(self):
        home = tempfile.mkdtemp(dir=self.root)
        taught = self.run_of("wam/demo/teach.yaml", TEACH, "taught_wam", cwd=home)
        with open(f"{home}/poses.yaml", encoding="utf-8") as file:
            self.assertIn("here", file.read())
        gone = self.run_of("wam/demo/teach.yaml", GO_THERE, "gone_there", cwd=home)
        with open(f"{home}/poses.yaml", "w", encoding="utf-8") as file:
            file.write("what was taught since then")
        before = files_in(home)
        self.expect_equal(taught, 100)
        self.assertEqual(files_in(home), before)
        os.remove(f"{home}/poses.yaml")
        self.expect_equal(gone, 100)
        self.assertEqual(files_in(home), {})

    def test_its_estop_is_replayed_with_its_black_box(self):
        folder = self.run_of("wam/demo/npid.yaml", WAM_ESTOP, "wam", code=1)
        self.assertTrue(any(name.startswith("blackbox-") for name in os.listdir(folder)))
        self.expect_equal(folder, 500)


class Rover(Recorded):
    def test_is_equal_to_the_bit(self):
        self.expect_equal(self.run_of("rover/demo/p.yaml", ROVER, "rover"), 50)

    def test_a_silent_encoder_is_replayed_with_its_black_box(self):
        folder = self.run_of("rover/demo/p.yaml", ROVER_SILENT, "silent", code=1)
        boxes = [name for name in os.listdir(folder) if name.startswith("blackbox-")]
        self.assertTrue(boxes)
        self.expect_equal(folder, 50)
        mutate(f"{folder}/{boxes[0]}", "Chassis.Drive.SpeedLeft")
        self.assertIn("Chassis.Drive, port SpeedLeft", self.replay(folder, code=5).stdout)


class Shadow(unittest.TestCase):
    EXAMPLE = os.path.join(os.path.dirname(ROBOTS.rstrip("/")), "examples", "14_shadow",
                           "shadow.yaml")

    def check(self, more, code):
        with tempfile.TemporaryDirectory() as folder:
            with open(f"{folder}/more.yaml", "w", encoding="utf-8") as file:
                file.write(f"include: {self.EXAMPLE}\n{more}")
            done = armature("check", f"{folder}/more.yaml", "-L", LIBRARIES)
            self.assertEqual(done.returncode, code, done.stderr)
            return done.stderr

    def test_that_only_looks_on_passes_the_check(self):
        self.check("", 0)

    def test_that_is_used_by_who_is_none_is_refused(self):
        shown = "components: {Show: {model: Number, %sproperties: {Unit: V}}}\n"
        connected = "connections: [Deviations.Largest -> Show.Value]\n"
        told = self.check(shown % "activity: triggered, " + connected, 1)
        self.assertIn("the shadow 'Deviations' writes 'Show.Value', which is not of a shadow", told)
        self.check(shown % "shadow: true, " + connected, 0)

    def test_whose_fault_would_stop_all_is_refused(self):
        self.assertIn("would stop everything if it faulted", self.check("on_fault: stop_all\n", 1))

    def test_that_takes_the_time_of_who_drives_is_refused(self):
        told = self.check("components:\n  Shadow: {override: true, activity: "
                          "{triggered: true, priority: 85}}\n", 1)
        self.assertIn("the shadow 'Shadow' is as urgent as the thread", told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
