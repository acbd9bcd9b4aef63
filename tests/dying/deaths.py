#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The WAM in real time, on the bus of an emulator process, whose controller, guardian or emulator dies
or stands still at a random time of a motion. Prints a table of what came of it, and fails if anything
is not as docs/promises.md has it.

usage: deaths.py PROGRAM EMULATOR LIBRARIES FOLDER_OF_VICTIM WAM_DIR [--runs N] [--only NAME,..] [--seed S]

Times on the bus are the emulator's: from the last frame of the dead controller to the guardian's first.
A run that the machine itself spoilt is told apart, and done again: on each CPU a process with a real-time
priority looks how late it is woken. When somebody died, this was longer than a guardian may take; or the
arm was let go because a cycle or answers of its pucks were late, and it was longer than they may be. Late
answers of the emulator have moved on since they were asked for, so that the tip looks fast to the
controller and to the safety board.
"""

import argparse
import glob
import os
import random
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "harness"))
from processes import LONG, Broken, Process, states_in, wait_for

GAP_MS = 10.0     # from the last frame of the controller to the guardian's first
MOVED_RAD = 0.02  # of the joint that moves most, until its motor has braked it
STALL_MS = 3.0    # that the machine stood still when somebody died
LATE_MS = 1.0     # more than a cycle of the arm has to spare for answers that are late
BRAKING_S = 0.05  # from then on braked joints sink by their weight alone
IDLE_FRAME = re.compile(r"\(0*([0-9.]+)\) \S+ (401|404|402)#880000000000$")
HOST_FRAME = re.compile(r"\(0*([0-9.]+)\) \S+ (0[0-9A-F]{2}|40[0-9A-F])#(.*)$")
# The way to where the tour's fastest motion begins, and that motion.
FIRST, THERE = [0.0, 0.0, 0.0, 1.57, 0.0, 0.0, 0.0], [1.2, 1.0, -0.8, 0.6, -1.5, 0.8, 1.2]
MOTION_S = 5.0
CUT_SHORT = "WAM: fault: |Generator.moveTo: (failed|cancelled)"


def watch_stalls(cpu):
    """How late this process is woken at most until its input ends [ms]; it has a real-time priority."""
    os.sched_setaffinity(0, {cpu})
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(97))
    except PermissionError:
        pass
    worst = 0.0
    while not select.select([sys.stdin], [], [], 0)[0]:
        due = time.monotonic() + 0.001
        time.sleep(0.001)
        worst = max(worst, (time.monotonic() - due) * 1000)
    print(worst)


class Stalls:
    """For how long the machine stands still while it runs."""

    def __init__(self):
        self.watchers = [subprocess.Popen([sys.executable, __file__, "--stalls", str(cpu)], stdin=subprocess.PIPE,
                                          stdout=subprocess.PIPE, text=True) for cpu in os.sched_getaffinity(0)]
        self.longest_ms = None
        time.sleep(0.1)

    def end(self):
        """The longest time [ms]."""
        if self.longest_ms is None:
            self.longest_ms = max(float(watcher.communicate()[0]) for watcher in self.watchers)
        return self.longest_ms


class CutShort(Broken):
    """The motion ended before it should; nobody need have died."""


class Arm(Process):
    """armature-wam-emulator, with its states and its frames."""

    def __init__(self, options, folder):
        self.bus = "virtual:" + os.path.join(folder, "bus")
        self.state_file, self.log_file = os.path.join(folder, "states"), os.path.join(folder, "frames")
        super().__init__([options.emulator, "--bus", self.bus, "--state", self.state_file, "--log",
                          self.log_file], folder)
        wait_for(lambda: os.path.exists(os.path.join(folder, "bus")), "the emulator is there")
        for key in ("home", "release", "idle"):
            self.say(key)

    def states(self):
        return states_in(self.state_file)

    def frames(self):
        with open(self.log_file, encoding="utf-8") as file:
            return file.read().splitlines()

    def wait_for_states(self, seconds):
        begin = self.states()[-1]["time"]
        wait_for(lambda: self.states()[-1]["time"] >= begin + seconds, f"{seconds} s pass on the arm")

    def guardians_first(self, after):
        """Seconds on the bus: the host's last frame, and the first behind it that sets the pucks idle,
        which is later than `after`."""
        last = None
        for line in self.frames():
            if idle := IDLE_FRAME.match(line):
                if float(idle[1]) > after and last is not None:
                    return last, float(idle[1])
            elif host := HOST_FRAME.match(line):
                last = float(host[1])
        return None


def velocities(states, i):
    step = states[i]["time"] - states[i - 1]["time"]
    return [(now - then) / step for now, then in zip(states[i]["position"], states[i - 1]["position"])]


def moved_after(states, when):
    """How far the joint that moves most has come from where it was at `when` until it is braked."""
    first = next(i for i, state in enumerate(states) if state["time"] >= when)
    before = states[first - 1]
    speed = velocities(states, first - 1)
    begin = [p + v * (when - before["time"]) for p, v in zip(before["position"], speed)]
    braked = next(state for state in states if state["time"] >= when + BRAKING_S)
    return max(abs(now - then) for now, then in zip(braked["position"], begin))


class Controller(Process):
    """armature run with computed torque, commanded line by line."""

    def __init__(self, options, arm, folder, *more):
        deployment = os.path.join(folder, "deployment.yaml")
        with open(deployment, "w", encoding="utf-8") as file:
            file.write(f"""
include: [{options.wam}/deployments/computed_torque7.yaml, {options.wam}/demo/recorder.yaml]
libraries: [victim]
components:
  Victim: {{model: Victim, activity: {{periodic: 10 ms, priority: 40}}}}
  Near: {{model: Victim, peers: [Sampler]}}
""")
        self.out = os.path.join(folder, "out")
        super().__init__([options.program, "run", deployment, "-L", options.libraries, "-L", options.victim,
                          "--set", f"bus={arm.bus}", "--set", "WAM.at_home=true", "--browse", "--out", self.out, *more],
                         folder)
        self.wait_until_it_says("waits for Shift+Activate")
        arm.say("activate")
        self.wait_until_it_says("holds the arm where it is")
        self.say("print('armed', wait(Arming:arm()))")
        self.wait_until_it_says("armed\ttrue")

    def move(self, to, seconds):
        numbers = ", ".join(str(number) for number in to)
        self.say(f"print('moved', pcall(function() return wait(Generator:moveTo(array({numbers}), {seconds})) end))")

    def begin_to_move(self, to, seconds):
        """The browser goes on: what is typed next is done during the motion."""
        numbers = ", ".join(str(number) for number in to)
        self.say(f"Generator:moveTo(array({numbers}), {seconds})")

    def wait_until_moved(self, times):
        """So many motions have ended as they should."""
        done = "(?s)" + ".*".join(["Generator.moveTo: done"] * times)
        self.assert_says(done + "|" + CUT_SHORT)
        if not re.search(done, self.text()):
            raise self.cut_short()

    def cut_short(self):
        time.sleep(0.5)  # why is told by another thread than what followed
        return CutShort("the motion was cut short; it said:\n" + self.text())

    def begin_fastest_motion(self):
        self.begin_to_move(FIRST, 4.0)  # slower: it is not what is measured
        self.wait_until_moved(1)
        self.begin_to_move(THERE, MOTION_S)

    def guardian(self):
        found = re.search(r"guarded by process (\d+)", self.text())
        if not found:
            raise Broken("nobody guards the arm: " + self.text())
        return int(found[1])

    def assert_says(self, pattern, limit=LONG):
        try:
            wait_for(lambda: re.search(pattern, self.text()), f"it says '{pattern}'", limit)
        except Broken as broken:
            raise Broken(f"{broken}; it said:\n{self.text()}") from None


def is_gone(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    with open(f"/proc/{process}/stat", encoding="utf-8") as file:
        return file.read().rsplit(")", 1)[1].split()[0] == "Z"


class Run:
    """One death; what was measured, if that means anything."""

    def __init__(self, options, chance):
        self.options, self.chance = options, chance
        self.folder = tempfile.TemporaryDirectory()
        self.gap_ms = self.moved = None
        self.stall_ms = 0.0
        self.arm = self.controller = None
        self.stalls = Stalls()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in (self.controller, self.arm):
            if process:
                process.process.send_signal(signal.SIGCONT)
                process.process.kill()
                process.process.wait()
        self.stalls.end()
        self.folder.cleanup()

    def says_nothing(self):
        """Its figures are those of a machine that stood still."""
        return self.stall_ms > STALL_MS

    def was_spoilt(self):
        """It failed since the machine stood still, by which a puck or a cycle was late."""
        said = self.controller.text() if self.controller else ""
        late = any(sign in said for sign in ("silent", "no cycle was run", "the tip gets too fast", "was too fast"))
        return self.says_nothing() or late and self.stalls.end() > LATE_MS

    def begin(self, *more):
        """The arm in the middle of the motion."""
        self.arm = Arm(self.options, self.folder.name)
        self.controller = Controller(self.options, self.arm, self.folder.name, *more)
        self.controller.begin_fastest_motion()
        time.sleep(self.chance.uniform(0.3, MOTION_S - 0.7))
        if re.search(CUT_SHORT, self.controller.text()):
            raise self.controller.cut_short()

    # ---- What is judged

    def judge_idle(self, act):
        """What `act` does to the controller leads to a guardian that idles the arm in time."""
        stalls = Stalls()
        before = self.arm.states()[-1]["time"]
        act()
        try:
            last, idle = wait_for(lambda: self.arm.guardians_first(before), "the pucks are set idle", 5.0)
            self.arm.wait_for_states(0.5)
        finally:
            self.stall_ms = stalls.end()
        self.gap_ms = (idle - last) * 1000
        self.moved = moved_after(self.arm.states(), last)

    def judge_figures(self):
        if self.says_nothing():
            return
        if self.gap_ms is not None and self.gap_ms > GAP_MS:
            raise Broken(f"{self.gap_ms:.1f} ms until the pucks were idle")
        if self.moved is not None and self.moved > MOVED_RAD:
            raise Broken(f"it moved {self.moved:.3f} rad")

    def judge_rest(self, seconds=1.0):
        """Nobody drives the arm any more: it sinks at most."""
        time.sleep(1.0)  # on a busy machine the emulator writes its states as late as this
        begin = self.arm.states()[-1]["time"]
        self.arm.wait_for_states(seconds)
        driven = [state["time"] - begin for state in self.arm.states()
                  if state["time"] > begin and max(abs(torque) for torque in state["torque"]) > 1e-9]
        if driven:
            raise Broken(f"a motor is driven for {max(driven):.3f} s")

    def judge_disarmed(self):
        if self.controller.ask("Arming.armed") != "false":
            raise Broken("it is still armed")

    # ---- Deaths of the controller

    def kill(self):
        self.begin()
        guardian = self.controller.guardian()
        self.judge_idle(lambda: self.controller.kill(signal.SIGKILL))
        self.controller.assert_says("armature-guardian: process .* has died; switches the drives off", 5)
        wait_for(lambda: is_gone(guardian), "the guardian ends", 10)
        self.judge_rest()

    def stop_for(self, seconds):
        self.begin()
        self.judge_idle(lambda: self.controller.kill(signal.SIGSTOP))
        time.sleep(seconds)
        self.controller.kill(signal.SIGCONT)
        self.controller.assert_says("WAM: fault: ")
        self.judge_rest()
        self.judge_disarmed()
        if self.controller.end() == 0:
            raise Broken("its exit code is 0")

    def crash(self, who, how, says):
        self.begin()
        say = lambda: self.controller.say(f"{who}:die('{how}')")
        if who == "Near":
            self.judge_idle(say)
        else:
            say()
        self.controller.assert_says(f"fatal: '{who}' in the thread '.*{says}", 10)
        code = self.controller.process.wait(timeout=LONG)
        if code == 0:
            raise Broken("its exit code is 0")
        self.judge_rest()
        if not glob.glob(os.path.join(self.controller.out, "blackbox-*")):
            raise Broken("there is no black box: " + self.controller.text())
        if os.path.getsize(os.path.join(self.controller.out, "wam.mcap")) == 0:
            raise Broken("the recording is empty")

    def hang(self):
        self.begin()
        self.judge_idle(lambda: self.controller.say("Near:die('hang')"))
        self.judge_rest()
        if self.controller.end() == 0:
            raise Broken("its exit code is 0")

    # ---- Of the others

    def guardian_killed(self, sent):
        self.begin()
        os.kill(self.controller.guardian(), sent)
        self.controller.assert_says("WAM: its guardian has died", 10)
        self.controller.wait_until_moved(2)
        os.kill(self.controller.guardian(), signal.SIGKILL)

    def guardian_required(self):
        self.begin("--set", "WAM.guardian=required")
        os.kill(self.controller.guardian(), signal.SIGKILL)
        self.controller.assert_says("WAM: fault: its guardian has died, and is required", 10)
        self.judge_rest()
        self.judge_disarmed()

    def emulator_killed(self):
        self.begin()
        self.arm.kill(signal.SIGKILL)
        self.controller.assert_says("WAM: fault: ", 10)
        self.judge_disarmed()
        if self.controller.end() == 0:
            raise Broken("its exit code is 0")

    def emulator_stopped(self, seconds):
        self.begin()
        self.arm.kill(signal.SIGSTOP)
        self.controller.assert_says("WAM: fault: ", 10)
        time.sleep(seconds)
        self.arm.kill(signal.SIGCONT)
        self.judge_disarmed()
        self.arm.wait_for_states(0.3)  # what it was told last counts until its board says otherwise
        self.judge_rest()

    # ---- The machine

    def overload(self):
        """Twenty busy processes: it moves on, or is disarmed: held, or out of service and not driven."""
        self.begin()
        busy = [subprocess.Popen([sys.executable, "-c", "import time; end = time.monotonic() + 1.5\n"
                                  "while time.monotonic() < end: pass"]) for _ in range(20)]
        for process in busy:
            process.wait(timeout=LONG)
        self.controller.assert_says("(?s)Generator.moveTo: done.*Generator.moveTo: done|" + CUT_SHORT)
        if re.search(CUT_SHORT, self.controller.text()):
            self.judge_disarmed()
        if "WAM: fault: " in self.controller.text():
            self.judge_rest()

    def disk_full(self):
        """The recording has no room: it is told, and the arm moves on."""
        out = os.path.join(self.folder.name, "out")
        os.mkdir(out)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", out], check=False,
                                 capture_output=True).returncode == 0
        if not mounted:
            return "skipped: no small disk can be made here"
        try:
            self.begin()
            self.controller.wait_until_moved(2)
            self.controller.say("quit")
            self.controller.process.wait(timeout=LONG)
            self.controller.assert_says("(?i)no space left")
        finally:
            subprocess.run(["umount", "-l", out], check=False)
        return None


DEATHS = {
    "controller killed": Run.kill,
    "controller stopped 0.1 s": lambda run: run.stop_for(0.1),
    "controller stopped 1 s": lambda run: run.stop_for(1.0),
    "controller stopped 10 s": lambda run: run.stop_for(10.0),
    "segmentation fault": lambda run: run.crash("Victim", "segv", "segmentation fault"),
    "abort": lambda run: run.crash("Victim", "abort", "abort"),
    "exit(0)": lambda run: run.crash("Victim", "exit", r"has called exit\(0\)"),
    "stack overflow beside the arm": lambda run: run.crash("Near", "overflow", "stack overflow"),
    "hang beside the arm": Run.hang,
    "guardian killed": lambda run: run.guardian_killed(signal.SIGKILL),
    "guardian stopped": lambda run: run.guardian_killed(signal.SIGSTOP),
    "required guardian killed": Run.guardian_required,
    "emulator killed": Run.emulator_killed,
    "emulator stopped 1 s": lambda run: run.emulator_stopped(1.0),
    "overload": Run.overload,
    "disk full": Run.disk_full,
}


def most(numbers, form):
    return form.format(max(numbers)) if numbers else "-"


def median(numbers, form):
    return form.format(sorted(numbers)[len(numbers) // 2]) if numbers else "-"


def repeat(name, options):
    """All runs of a death; how many failed."""
    gaps, moves, done, failed, spoilt, skipped = [], [], 0, 0, 0, ""
    while done < options.runs and spoilt < 3 * options.runs and not skipped:
        with Run(options, random.Random(f"{options.seed} {name} {done} {spoilt}")) as run:
            broken = None
            try:
                skipped = DEATHS[name](run) or ""
                run.judge_figures()
            except (Broken, OSError, subprocess.TimeoutExpired) as problem:
                broken = problem
            if run.was_spoilt() if broken else run.says_nothing():
                spoilt += 1
                continue
            done += 1
            if broken:
                failed += 1
                print(f"FAILED: {name}, run {done}: {broken}", file=sys.stderr, flush=True)
            elif run.gap_ms is not None:
                gaps.append(run.gap_ms)
                moves.append(run.moved)
    print(f"{name:<32} {done:>5} {failed:>7} {spoilt:>7} {median(gaps, '{:.1f}'):>9} "
          f"{most(gaps, '{:.1f}'):>9} {most(moves, '{:.4f}'):>11}  {skipped}", flush=True)
    return failed


def main():
    parser = argparse.ArgumentParser()
    for name in ("program", "emulator", "libraries", "victim", "wam"):
        parser.add_argument(name, type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=30)
    parser.add_argument("--only", default=",".join(DEATHS))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(f"{'death':<32} {'runs':>5} {'failed':>7} {'spoilt':>7} {'idle [ms]':>9} {'most [ms]':>9} "
          f"{'moved [rad]':>11}")
    failed = sum(repeat(name, options) for name in options.only.split(","))
    if failed:
        print(f"{failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(watch_stalls(int(sys.argv[2])) if sys.argv[1:2] == ["--stalls"] else main())
