#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A generated program does what `armature run` does of the same deployment, to the bit; what it cannot do is
refused.

usage: generate_test.py CMAKE BUILD_DIR SOURCE_DIR CXX_COMPILER FOLDER_OF_VICTIM
"""

import filecmp
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

CMAKE, BUILD, SOURCE, COMPILER, VICTIM = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4], sys.argv[5]
LIBRARIES = BUILD / "lib" / "armature"  # of the examples
EXAMPLES = SOURCE / "examples"
JANUS = SOURCE / "robots" / "janus"
WAM = SOURCE / "robots" / "wam"
LONG = 30.0
# Reads deployments, serves tools: none of it is for a small board. (pugixml is: the recorder reads the robot's description by it.)
NOT_LINKED = re.compile(r"yaml|lua|libarmature_(deploy|document|orocos|edit|remote|ride|lua|browser|inspect)|ssl")


def run(*words, **options):
    options = {"capture_output": True, "text": True, "timeout": 300, **options}
    return subprocess.run([str(word) for word in words], **options)


def setUpModule():
    """An installation, which programs are built against."""
    global prefix, program
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    prefix = Path(folder.name) / "prefix"
    done = run(CMAKE, "--install", BUILD, "--prefix", prefix)
    if done.returncode != 0:
        raise RuntimeError("installing failed: " + done.stdout + done.stderr)
    program = prefix / "bin" / "armature"


def wait_for(condition, what):
    end = time.monotonic() + LONG
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.02)
    raise AssertionError(f"in vain: {what}")


def is_gone(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except FileNotFoundError:
        return True


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


class Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="generate test ")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, text, name="deployment/robot.yaml"):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def generate(self, deployment, *more, out="program", code=0):
        done = run(program, "generate", deployment, "-L", LIBRARIES, "-L", VICTIM, "--out", self.folder / out, *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def build(self, out="program"):
        """The program of what was generated."""
        source = self.folder / out
        for step in (["-G", "Ninja", "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={prefix}",
                      f"-DCMAKE_CXX_COMPILER={COMPILER}", f"-DARMATURE_LIBRARY_PATH={LIBRARIES};{VICTIM}"],
                     ["--build", source / "build"]):
            done = run(CMAKE, *step)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        name = re.search(r"^project\((\S+) ", (source / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
        return source / "build" / name

    def made(self, deployment, *more):
        self.generate(deployment, *more)
        return self.build()

    def run_deployment(self, deployment, *arguments):
        return run(program, "run", deployment, "-L", LIBRARIES, "-L", VICTIM, *arguments)

    def assert_same(self, deployment, *arguments, files=()):
        """What both say of a run in simulated time, how they end and what they record."""
        made = self.made(deployment)
        folders = [self.folder / "run", self.folder / "gen"]
        out = [["--out", folder] if files else [] for folder in folders]
        expected = self.run_deployment(deployment, "--sim", *arguments, *out[0])
        done = run(made, "--sim", *arguments, *out[1])
        # A run tells what its check notes and who is granted what; a program is checked, and has no tools.
        said = [re.sub("(note: the load|armature: scripts may do) .*\n", "", each.stdout + each.stderr)
                for each in (expected, done)]
        said[0] = said[0].replace(str(folders[0]), str(folders[1]))
        self.assertEqual(said[0], said[1])
        self.assertEqual(expected.returncode, done.returncode)
        for name in files:
            self.assertTrue(filecmp.cmp(folders[0] / name, folders[1] / name, shallow=False), name)
        return done

    def assert_linked_lightly(self, made):
        libraries = run("ldd", made, check=True).stdout
        self.assertIn("libarmature_exec", libraries)
        self.assertEqual([line for line in libraries.splitlines() if NOT_LINKED.search(line.split(" => ")[0])], [])


class Programs(Test):
    def test_the_head_of_janus_is_recorded_to_the_same_byte(self):
        self.assert_same(JANUS / "demo" / "pid.yaml", "--for", "8s", files=["janus.csv", "janus.mcap"])
        self.assert_linked_lightly(self.folder / "program" / "build" / "janus-pid")
        self.assertEqual((self.folder / "program" / "data" / "janus.urdf").read_bytes(),
                         (JANUS / "janus.urdf").read_bytes())

    def test_an_arm_with_seven_joints_is_recorded_to_the_same_byte(self):
        self.assert_same(WAM / "demo" / "npid.yaml", "--for", "3s", files=["wam.csv", "wam.mcap"])

    def test_composites_and_ranges_say_the_same_to_the_bit(self):
        deployment = self.write(f"""
include: {EXAMPLES}/05_composite/chassis.yaml
libraries: [record]
components:
  Reporter:
    model: Reporter
    activity: {{periodic: 10 ms}}
    properties: {{what: ["*"], file: all.mcap, csv: all.csv}}
  Other{{1..3}}: {{model: Wheel, properties: {{Radius: "{{i}} cm"}}}}
connections:
  - Driver.Forward -> Other{{i}}.Speed
""")
        done = self.assert_same(deployment, "--for", "2s", files=["all.mcap", "all.csv"])
        self.assertIn("wheels have turned 32.00000000000002 and 48.000000000000036 rad", done.stderr)

    def test_events_give_the_same_commands(self):
        done = self.assert_same(EXAMPLES / "09_task_decomposition" / "courier.yaml", "--for", "30s")
        self.assertEqual(done.stderr, (EXAMPLES / "09_task_decomposition" / "expected.txt").read_text())

    def test_parameters_of_commands_come_from_constants_ports_and_members(self):
        deployment = self.write(f"""
include: {EXAMPLES}/09_task_decomposition/courier.yaml
libraries: [controls, record]
components:
  Beat: {{model: Timer, activity: {{periodic: 10 ms}}, properties: {{Period: 5 s}}}}
  Return: {{model: Timer, activity: {{periodic: 10 ms}}, properties: {{Period: 7 s}}}}
  Reporter:
    model: Reporter
    activity: {{periodic: 20 ms}}
    properties: {{what: ["*"], file: all.mcap}}
connections:
  - {{on: Beat.Tick, do: Travel.goTo, name: Out, with: {{place: 3.5}}}}
  - {{on: Return.Tick, do: Travel.goTo, name: Back, max_age: 1 s, with: {{place: Body.Place}}}}
""")
        self.assert_same(deployment, "--for", "30s", files=["all.mcap"])
        text = (self.folder / "program" / "main.cpp").read_text()
        self.assertIn('{member(0)}', text)
        self.assertIn('{constant(3.5)}', text)
        self.assertIn('.max_age = 1s}, {port("place", "Body.Place")}', text)

    def test_modes_policies_and_reactions_are_those_of_the_deployment(self):
        deployment = self.write("""
application: policies
on_fault: stop_all
hold_at_stop: 2 s
black_box: {history: 1 s, memory_kB: 32}
libraries: [controls]
components:
  A: {model: Constant, activity: {periodic: 10 ms, thread: one, overrun: catch_up, budget: 1 ms}}
  B: {model: Constant, autostart: false, activity: {periodic: 10 ms, thread: one, overrun: catch_up, budget: 1 ms}}
  Sum: {model: Adder, activity: {periodic: 20 ms, priority: 5, cpus: [0], scheduler: realtime}, properties: {Inputs: 1}}
connections:
  - {from: A.Out, to: Sum.In1, policy: {fifo: 7, overflow: drop_oldest}, max_age: 1 s, on_old: hold, on_lost: zero}
modes: {first: [A], second: [A]}
mode: second
""")
        self.assert_same(deployment, "--for", "1s")
        text = re.sub(r"\s+", " ", (self.folder / "program" / "main.cpp").read_text())
        for part in (".thread = \"one\"", ".overrun = Overrun::kCatchUp", ".budget = 1ms", ".autostart(false)",
                     ".kind = ConnectionPolicy::Kind::kFifo, .capacity = 7, .when_full = WhenFull::kDropOldest",
                     ".max_age(1s, Reaction::kHold) .on_lost(Reaction::kZero)", "OnFault::kStopAll",
                     "hold_at_stop = 2s", "history = 1s", "memory = 32000", 'to.initial_mode("second")'):
            self.assertIn(part, text)

    def test_what_is_held_at_a_stop_is_let_go_of_as_by_a_run(self):
        deployment = self.write("""
application: holding
libraries: [victim]
hold_at_stop: 1 s
components:
  Weight: {model: Weight, activity: {periodic: 10 ms}}
""")
        done = self.assert_same(deployment, "--for", "1s")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'Weight' lets go, since no answer came: it held a weight", done.stderr)

    def late(self, reaction):
        """How a run and a program end whose data is too old."""
        deployment = self.write(f"""
application: late
libraries: [controls]
components:
  Slow: {{model: Constant, activity: {{periodic: 1 s}}}}
  Sum: {{model: Adder, activity: {{periodic: 10 ms}}, properties: {{Inputs: 1}}}}
connections: [{{from: Slow.Out, to: Sum.In1, max_age: 100 ms, on_old: {reaction}}}]
""")
        made = self.made(deployment)
        arguments = ["--sim", "--for", "3s", "--out"]
        ends = [self.run_deployment(deployment, *arguments, self.folder / "run"),
                run(made, *arguments, self.folder / "gen")]
        why = [re.findall("Sum: .*older than declared", end.stderr) for end in ends]
        self.assertTrue(why[0])
        self.assertEqual(why[0], why[1])
        boxes = [len(list((self.folder / folder).glob("blackbox-Sum-*.mcap"))) for folder in ("run", "gen")]
        return [end.returncode for end in ends], boxes

    def test_a_reaction_ends_it_with_its_exit_code(self):
        self.assertEqual(self.late("stop"), ([4, 4], [0, 0]))

    def test_a_fault_ends_it_with_its_exit_code_and_a_black_box(self):
        self.assertEqual(self.late("fault"), ([1, 1], [1, 1]))

    def test_a_crash_is_named_as_by_a_run(self):
        deployment = self.write("""
application: dying
libraries: [victim]
components:
  Victim: {model: Victim, activity: {periodic: 10 ms}, properties: {How: segv, After: 20}}
""")
        made = self.made(deployment)
        expected = self.run_deployment(deployment, "--sim", "--for", "1s")
        done = run(made, "--sim", "--for", "1s")
        named = [re.search("fatal: .*", each.stderr)[0] for each in (expected, done)]
        self.assertIn("Victim", named[1])
        self.assertEqual(re.sub(r"0x\w+", "", named[0]), re.sub(r"0x\w+", "", named[1]))
        self.assertEqual(expected.returncode, done.returncode)


HELLO = """
application: hello
libraries: [controls]
components:
  Source: {model: Constant, activity: {periodic: 10 ms, priority: 20}, properties: {Value: 4}}
"""


class Runs(Test):
    def test_every_signal_that_stops_a_run_stops_it_in_order(self):
        # nohup, and a script's job in the background, ignore these from the start.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
        made = self.made(self.write(HELLO))
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(sent=sent):
                log = self.folder / sent.name
                with log.open("w") as file:
                    process = subprocess.Popen([made, "--statistics"], stderr=file)
                self.addCleanup(process.kill)
                wait_for(lambda: "Source: asked for" in log.read_text(), "it runs")
                time.sleep(0.3)  # some cycles
                process.send_signal(sent)
                process.wait(LONG)
                said = log.read_text()
                self.assertEqual(process.returncode, 0, said)
                self.assertRegex(said, r"thread Source: [0-9]+ cycles run")

    def test_a_wrong_option_is_wrong_use(self):
        made = self.made(self.write(HELLO))
        self.assertIn("--for TIME", run(made, "--help").stdout)
        done = run(made, "--fro", "1s")
        self.assertEqual(done.returncode, 2)
        self.assertIn("unknown option '--fro' (did you mean '--for'?)", done.stderr)

    def test_it_refuses_to_run_anything_but_what_was_checked(self):
        made = self.made(JANUS / "deployments" / "pid.yaml")
        refusal = "this is not the application that passed the check when 'janus-pid' was generated"
        main = self.folder / "program" / "main.cpp"
        text = main.read_text()
        for found, by in (('.set("Kp", 400.0)', '.set("Kp", 401.0)'),
                          ('  to.connect("PID1.Out", "Controller.Out1");\n', "")):
            self.assertIn(found, text)
            main.write_text(text.replace(found, by))
            done = run(self.build(), "--sim", "--for", "100ms")
            self.assertEqual(done.returncode, 1)
            self.assertIn(refusal, done.stderr)
        main.write_text(text)
        self.assertEqual(run(self.build(), "--sim", "--for", "100ms").returncode, 0)
        urdf = made.parent / "data" / "janus.urdf"
        urdf.write_text(urdf.read_text() + "<!-- heavier -->")
        self.assertIn(refusal, run(made, "--sim", "--for", "100ms").stderr)

    def test_a_robot_has_its_guardian(self):
        bus = self.folder / "bus"
        made = self.made(JANUS / "deployments" / "on_can.yaml", "--set", f"bus=virtual:{bus}")
        plant = subprocess.Popen([prefix / "bin" / "armature-janus-plant", "--bus", bus], stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL)
        self.addCleanup(lambda: (plant.kill(), plant.wait()))
        wait_for(bus.exists, "the head is there")
        log = self.folder / "log"
        with log.open("w") as file:
            process = subprocess.Popen([made], stderr=file)
        self.addCleanup(process.kill)
        guardian = int(wait_for(lambda: re.search(r"guarded by process (\d+)", log.read_text()), "a guardian")[1])
        process.send_signal(signal.SIGKILL)
        process.wait()
        wait_for(lambda: re.search("armature-guardian: process .* has died; switches the drives off", log.read_text()),
                 "the guardian acts")
        wait_for(lambda: is_gone(guardian), "the guardian ends")


class Sources(Test):
    def test_no_other_command_has_the_generator_in_memory(self):
        self.assertNotIn("libarmature_generate", run("ldd", program, check=True).stdout)
        self.assertTrue((prefix / "lib" / "libarmature_generate.so").exists())

    def test_the_same_deployment_gives_the_same_bytes(self):
        self.generate(JANUS / "demo" / "pid.yaml")
        self.generate(os.path.relpath(JANUS / "demo" / "pid.yaml"), out="other")
        made = contents(self.folder / "program")
        self.assertEqual(made, contents(self.folder / "other"))
        self.assertEqual(list(made), ["CMakeLists.txt", "README", "data/janus.urdf", "main.cpp"])

    def test_they_have_no_path_of_this_machine(self):
        self.generate(JANUS / "demo" / "pid.yaml")
        text = b"".join(contents(self.folder / "program").values()).decode()
        for path in (SOURCE, BUILD, prefix, self.folder):
            self.assertNotIn(str(path), text)

    def test_they_are_written_anew_and_what_else_is_there_stays(self):
        deployment = self.write(HELLO)
        self.generate(deployment)
        self.write("mine", "program/notes")
        deployment.write_text(HELLO.replace("Value: 4", "Value: 5"))
        self.generate(deployment)
        self.assertIn('.set("Value", 5.0)', (self.folder / "program" / "main.cpp").read_text())
        self.assertEqual((self.folder / "program" / "notes").read_text(), "mine")
        self.write("mine", "other/main.cpp")
        told = self.generate(deployment, out="other", code=1)
        self.assertIn("is not empty, and has no program that was generated", told)
        self.assertEqual(list(contents(self.folder / "other")), ["main.cpp"])

    def test_lines_fit_into_a_hundred_columns(self):
        self.generate(WAM / "demo" / "npid.yaml")
        self.assertLessEqual(max(map(len, (self.folder / "program" / "main.cpp").read_text().splitlines())), 100)


class Refusals(Test):
    def refuse(self, text, says, *more, name="deployment/robot.yaml"):
        told = self.generate(self.write(text, name) if isinstance(text, str) else text, *more, code=1)
        self.assertIn(says, told)
        self.assertFalse((self.folder / "program").exists(), "something is left")

    def test_what_the_check_refuses_is_refused(self):
        self.refuse(HELLO.replace("Value: 4", "Valeu: 4"), "has no property 'Valeu'")
        self.refuse(JANUS / "deployments" / "pid.yaml", "'PID1': Joint1: shakes", "--set", "PID1.Kp=400000")

    def test_what_other_processes_do_is_refused(self):
        self.refuse(HELLO + "network: {listen: ['unix:robot.sock']}\n",
                    "the application listens at 'unix:robot.sock', and a generated program serves no other processes")
        self.refuse(JANUS / "deployments" / "operator.yaml",
                    "'Arming' lives in another process, and a generated program connects to none")
        self.refuse(HELLO + """  Sum: {model: Adder, activity: {periodic: 10 ms}, properties: {Inputs: 1}}
network: {inputs: [{to: Sum.In1, max_age: 1 s}]}
""", "'Sum.In1' is written by other processes, and a generated program serves none")

    def test_calls_that_a_deployment_names_are_refused(self):
        self.refuse(HELLO + """  Go: {model: Button}
  Series: {model: Sequence, calls: [Go.press]}
""", "'Series' calls what the deployment names (calls), and a generated program names nothing by text")

    def test_what_the_operator_does_is_refused_or_told(self):
        self.refuse(HELLO + """  Sum: {model: Adder, activity: {periodic: 10 ms}, properties: {Inputs: 1}}
operator_inputs: [Sum.In1]
""", "'Sum.In1' is written by the operator, who has no tool for a generated program")
        self.refuse(HELLO.replace("controls", "controls, record") + "  Prompt: {model: TaskBrowser}\n",
                    "'Prompt' stands for the operator's prompt, which a generated program has not")
        self.refuse(WAM / "deployments" / "npid7.yaml", "'WAM.at_home' is the operator's word, which counts for one run",
                    "--set", "WAM.at_home=true")
        told = self.generate(JANUS / "deployments" / "pid.yaml")
        self.assertIn("note: 'Arming.arm' is an act of the operator, who has no tool for a generated program", told)
        self.assertIn("note: grants for scripts have no effect in a generated program", told)

    def test_files_that_it_has_not_are_refused(self):
        self.write("<properties/>", "deployment/source.cpf")
        self.refuse(HELLO.replace("properties: {Value: 4}", "property_file: source.cpf, autosave: true"),
                    "'Source' saves its properties (autosave), and a generated program has no property files")
        self.refuse(HELLO.replace("controls", "controls, record") + """  Reporter:
    {model: Reporter, activity: {periodic: 10 ms}, properties: {what: [Source.Out], csv: "${here}/out.csv"}}
""", "'Reporter.csv' names a place beside the deployment, which a generated program does not have")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[6:])
