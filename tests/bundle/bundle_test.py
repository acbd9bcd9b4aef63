#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `armature bundle` makes runs elsewhere, as here; what it refuses leaves nothing.

usage: bundle_test.py CMAKE BUILD_DIR SOURCE_DIR
"""

import filecmp
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

CMAKE, BUILD, SOURCE = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
PROGRAM = BUILD / "bin" / "armature"
WAVE = SOURCE / "examples" / "02_ports_and_triggers"
JANUS = SOURCE / "robots" / "janus"
IN_DEPLOYMENT = "deployment/"


def setUpModule():
    """An installation, since programs of a build tree look for their libraries there."""
    global prefix
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    prefix = Path(folder.name) / "prefix"
    done = subprocess.run([CMAKE, "--install", BUILD, "--prefix", prefix, "--strip"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError("installing failed: " + done.stdout + done.stderr)


def run(*words, **options):
    options = {"capture_output": True, "text": True, "timeout": 300, **options}
    return subprocess.run([str(word) for word in words], **options)


def files_in(folder):
    return sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*") if path.is_file())


class Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="bundle test ")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.work = self.folder / "work"
        self.work.mkdir()

    def write(self, name, text=""):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def deployment(self, components="", more="", name="robot/hello.yaml"):
        """Of components that any installation has."""
        return self.write(name, "application: hello\nlibraries: [controls]\n" + more + "components:\n"
                          "  Source: {model: Constant, activity: {periodic: 10 ms}}\n" + components)

    def bundle(self, *arguments, code=0, installation=True, program=PROGRAM):
        where = ["--installation", prefix] if installation else []
        done = run(program, "bundle", *arguments, *where, cwd=self.work)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def refuse(self, *arguments, says, **options):
        told = self.bundle(*arguments, code=1, **options)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, told)
        self.assertEqual(files_in(self.work), [], "something half is left")
        self.assertEqual(list(self.work.iterdir()), [])


class Folders(Test):
    def check_loaded(self, folder, *arguments):
        """Runs with an empty environment but for the loader's diary: of Armature it loads its own."""
        diary = self.folder / "loaded"
        done = run("env", "-i", "LD_DEBUG=files", f"LD_DEBUG_OUTPUT={diary}", *arguments)
        loaded = "".join(path.read_text() for path in self.folder.glob("loaded.*"))
        ours = re.findall(r"calling init: (.*libarmature_.*|.*/lib/armature/.*)", loaded)
        self.assertTrue(ours)
        self.assertEqual([path for path in ours if not path.startswith(str(folder))], [])
        return done

    def test_it_runs_elsewhere_without_the_build_and_the_installation(self):
        self.bundle(WAVE / "wave.yaml")
        moved = self.folder / "some other place"
        shutil.move(self.work / "wave-bundle", moved)
        prefix.rename(prefix.with_name("away"))
        self.addCleanup(lambda: prefix.with_name("away").rename(prefix))
        done = self.check_loaded(moved, moved / "run", "--sim", "--for", "1s")
        self.assertEqual(done.stdout + done.stderr, (WAVE / "expected.txt").read_text())
        link = self.folder / "link"
        link.symlink_to(moved / "run")
        self.assertEqual(run("env", "-i", link, "--sim", "--for", "1s").stderr, done.stderr)

    def test_a_robot_that_its_script_commands_is_recorded_to_the_same_byte(self):
        script = JANUS / "experiment.lua"
        told = self.bundle(JANUS / "demo" / "pid.yaml", "--script", script)
        bundle = self.work / "janus-pid-bundle"
        self.assertTrue(told.endswith(f"armature: made {bundle}\n"), told)
        self.assertEqual([name for name in files_in(bundle) if name.startswith(IN_DEPLOYMENT)],
                         [IN_DEPLOYMENT + name for name in
                          ("demo/pid.yaml", "demo/recorder.yaml", "deployments/control.yaml",
                           "deployments/pid.yaml", "experiment.lua", "janus.urdf")])
        self.assertEqual(files_in(bundle / "lib" / "armature"), ["libjanus.so", "librecord.so", "librobot.so"])
        here, there = self.folder / "here", self.folder / "there"
        run(PROGRAM, "run", JANUS / "demo" / "pid.yaml", "--sim", "--for", "8s", "--script", script,
            "--out", here, check=True)
        run("env", "-i", bundle / "run", "--sim", "--for", "8s", "--out", there, check=True)
        for name in ("janus.csv", "janus.mcap"):
            self.assertTrue(filecmp.cmp(here / name, there / name, shallow=False), name)

    def test_its_hashes_are_those_of_all_its_files(self):
        self.bundle(WAVE / "wave.yaml", "-L", BUILD / "lib" / "armature", installation=False,
                    program=prefix / "bin" / "armature")
        bundle = self.work / "wave-bundle"
        run("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=bundle, check=True)
        listed = [line[66:] for line in (bundle / "SHA256SUMS").read_text().splitlines()]
        self.assertEqual(sorted(listed + ["SHA256SUMS"]), files_in(bundle))
        self.assertTrue((bundle / "deployment" / "wave.yaml").stat().st_mode & stat.S_IROTH)
        self.assertTrue(filecmp.cmp(bundle / "LICENSE", SOURCE / "LICENSE", shallow=False))

    def test_two_of_the_same_inputs_are_equal(self):
        self.bundle(WAVE / "wave.yaml", "--out", "one")
        self.bundle(WAVE / "wave.yaml", "--out", "two")
        one, two = self.work / "one", self.work / "two"
        self.assertEqual(files_in(one), files_in(two))
        for name in files_in(one):
            self.assertTrue(filecmp.cmp(one / name, two / name, shallow=False), name)
            self.assertEqual((one / name).stat().st_mtime, (two / name).stat().st_mtime, name)

    def test_it_replaces_a_bundle_of_its_own_as_a_whole(self):
        self.bundle(WAVE / "wave.yaml")
        (self.work / "wave-bundle" / "stale").write_text("")
        self.bundle(WAVE / "wave.yaml")
        self.assertNotIn("stale", files_in(self.work / "wave-bundle"))
        self.assertEqual([path.name for path in self.work.iterdir()], ["wave-bundle"])
        told = self.bundle(self.deployment(), "--out", "wave-bundle", code=1)
        self.assertIn("wave-bundle' is there, and is no bundle of 'hello' that may be replaced", told)

    def test_an_installed_program_bundles_itself(self):
        self.bundle(self.deployment(), installation=False, program=prefix / "bin" / "armature")
        self.assertIn("bin/armature-guardian", files_in(self.work / "hello-bundle"))
        self.assertNotIn("lib/libarmature_bundle.so.0.1", files_in(self.work / "hello-bundle"))

    def test_mode_and_settings_are_those_of_its_runs(self):
        file = self.deployment(more="modes: {one: [Source]}\n")
        self.bundle(file, "--mode", "one", "--set", "Source.Value=2")
        script = (self.work / "hello-bundle" / "run").read_text()
        self.assertIn("'--set' 'Source.Value=2' '--mode' 'one' \"$@\"", script)

    def test_names_with_blanks_and_quotes_and_read_only_files(self):
        file = self.deployment(name="ann's robots/the $arm.yaml")
        file.chmod(0o400)
        self.bundle(file, "--out", self.work / "a bundle")
        done = run("env", "-i", self.work / "a bundle" / "run", "--sim", "--for", "1s", cwd="/")
        self.assertEqual(done.returncode, 0, done.stderr)


    def test_every_deployment_of_the_robots_passes_its_check_in_a_bundle(self):
        files = [file for pattern in ("*/deployments/**/*.yaml", "*/deployments/**/*.xml", "*/demo/*.yaml")
                 for file in sorted((SOURCE / "robots").glob(pattern))]
        whole = [file for file in files if run(PROGRAM, "check", file).returncode == 0]
        self.assertGreater(len(whole), 20)
        for file in whole:
            with self.subTest(file=file):
                self.bundle(file, "--out", "robot")
                shutil.rmtree(self.work / "robot")


class Keys(Test):
    def setUp(self):
        super().setUp()
        if not shutil.which("openssl"):
            self.skipTest("there is no openssl")
        robot = self.folder / "robot"
        robot.mkdir()
        run("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc",
            "-keyout", "robot.key", "-out", "robot.pem", "-subj", "/CN=robot", cwd=robot, check=True)
        self.write("robot/robot.policy", "allow operator@tls read *\n")
        self.file = self.deployment(more="network: {listen: \"tls://127.0.0.1:0\", policy: robot.policy,\n"
                                    "  tls: {certificate: robot.pem, key: robot.key, authority: robot.pem}}\n")

    def test_a_private_key_stays_at_home(self):
        told = self.bundle(self.file)
        self.assertIn("note: the private key 'deployment/robot.key' is not in the bundle", told)
        bundle = self.work / "hello-bundle"
        self.assertEqual(sorted(os.listdir(bundle / "deployment")), ["hello.yaml", "robot.pem", "robot.policy"])
        self.assertIn("\n  deployment/robot.key\n", (bundle / "README").read_text())
        self.assertNotEqual(run(bundle / "run", "--sim", "--for", "1s").returncode, 0)
        shutil.copy(self.folder / "robot" / "robot.key", bundle / "deployment")
        self.assertEqual(run("env", "-i", bundle / "run", "--sim", "--for", "1s").returncode, 0)

    def test_one_that_hides_in_another_file_is_refused(self):
        both = self.folder / "robot" / "robot.pem"
        both.write_text(both.read_text() + (self.folder / "robot" / "robot.key").read_text())
        self.refuse(self.file, says="robot.pem' has a private key, which must not leave this machine")


@unittest.skipUnless(shutil.which("dpkg-deb"), "there is no dpkg-deb")
class Packages(Test):
    def test_it_installs_below_opt_and_starts_nothing(self):
        self.bundle(JANUS / "deployments" / "pid.yaml", "--deb")
        archive = next(self.work.glob("armature-janus-pid_*.deb"))
        about = run("dpkg-deb", "--field", archive, check=True).stdout
        self.assertRegex(about, r"(?m)^Depends: .*\blibc6\b.*\blibmujoco[0-9.]+\b.*\blibyaml-cpp")
        listed = run("dpkg-deb", "--contents", archive, check=True).stdout
        self.assertEqual([line for line in listed.splitlines() if " root/root " not in line], [])
        self.assertEqual(run("dpkg-deb", "--ctrl-tarfile", archive, text=False, check=True).stdout.count(b"postinst"), 0)
        root = self.folder / "root"
        run("dpkg-deb", "-x", archive, root, check=True)
        done = run("env", "-i", root / "opt/armature/janus-pid/run", "--sim", "--for", "1s")
        self.assertEqual(done.returncode, 0, done.stderr)
        run("sha256sum", "--check", "--strict", "SHA256SUMS", cwd=root / "opt/armature/janus-pid", check=True)
        self.check_unit(root / "lib/systemd/system/janus-pid.service", root)

    def check_unit(self, unit, root):
        if not shutil.which("systemd-analyze"):
            return
        here = self.write("janus-pid.service", re.sub("ExecStart=(.*)", f"ExecStart=\"{root}\\1\"", unit.read_text()))
        done = run("systemd-analyze", "verify", "--man=no", here)
        self.assertNotRegex(done.stderr, r"janus-pid\.service:\d+|Unknown|Invalid|not executable")

    def test_two_of_the_same_inputs_are_equal_and_the_second_replaces_the_first(self):
        self.bundle(WAVE / "wave.yaml", "--deb")
        archive = next(self.work.iterdir())
        first = archive.read_bytes()
        self.bundle(WAVE / "wave.yaml", "--deb")
        self.assertEqual(list(self.work.iterdir()), [archive])
        self.assertEqual(archive.read_bytes(), first)
        told = self.bundle(self.deployment(), "--deb", "--out", archive, code=1)
        self.assertIn("is there, and is no package of 'hello'", told)


class ForABoard:
    """Stand-ins for an Armature on a board, whose `check` says what it is given."""

    PROGRAM = """#include <cstdio>
                 int said();
                 int main(int, char** words) {
                   std::printf("%s %s\\n", words[1], words[2]);
                   return std::fopen(words[2], "r") == nullptr ? 1 : said();
                 }"""

    def install(self, code):
        folder = self.folder / self.ARCHITECTURE
        for made, text, options in (
                ("lib/libarmature_said.so.0.1", f"int said() {{ return {code}; }}", ["-shared", "-Wl,-soname,libarmature_said.so.0.1"]),
                ("lib/armature/libcontrols.so", "int controls() { return 0; }", ["-shared"]),
                ("bin/armature", self.PROGRAM, [folder / "lib/libarmature_said.so.0.1", "-Wl,-rpath,$ORIGIN/../lib"]),
                ("bin/armature-guardian", "int main() {}", [])):
            source = self.write("source.cpp", text)
            (folder / made).parent.mkdir(parents=True, exist_ok=True)
            run(self.COMPILER, "-fPIC", source, "-o", folder / made, *options, check=True)
        shutil.copytree(prefix / "share", folder / "share")
        return folder

    def test_it_has_what_was_built_for_the_board_and_is_checked_there(self):
        folder = self.install(code=0)
        told = run(PROGRAM, "bundle", self.deployment(), "--for", self.ARCHITECTURE, "--installation", folder, cwd=self.work)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertNotIn("was not checked", told.stderr)
        bundle = self.work / "hello-bundle"
        for name in ("bin/armature", "lib/libarmature_said.so.0.1", "lib/armature/libcontrols.so"):
            self.assertTrue(filecmp.cmp(bundle / name, folder / name, shallow=False), name)
        self.assertIn(f"for Debian 12 on {self.ARCHITECTURE}", (bundle / "README").read_text())

    def test_what_fails_on_the_board_is_not_handed_over(self):
        done = run(PROGRAM, "bundle", self.deployment(), "--for", self.ARCHITECTURE, "--installation",
                   self.install(code=1), cwd=self.work)
        self.assertEqual(done.returncode, 1)
        self.assertIn("the check fails in the bundle, though it passes here:\ncheck ", done.stderr)
        self.assertEqual(list(self.work.iterdir()), [])


@unittest.skipUnless(shutil.which("aarch64-linux-gnu-g++") and shutil.which("qemu-aarch64"),
                     "there is no compiler for arm64, or nothing that runs what it makes")
class ForArm64(ForABoard, Test):
    ARCHITECTURE, COMPILER = "arm64", "aarch64-linux-gnu-g++"


@unittest.skipUnless(shutil.which("arm-linux-gnueabihf-g++") and shutil.which("qemu-arm"),
                     "there is no compiler for armhf, or nothing that runs what it makes")
class ForArmhf(ForABoard, Test):
    ARCHITECTURE, COMPILER = "armhf", "arm-linux-gnueabihf-g++"


class Refusals(Test):
    def test_a_deployment_with_errors(self):
        self.refuse(self.deployment("  Wrong: {model: Sauce}\n"),
                    says=["unknown model 'Sauce'", "hello.yaml has errors: no bundle is made"])

    def test_a_program_of_a_build_tree(self):
        self.refuse(self.deployment(), installation=False,
                    says=["as in a build tree; expected an installation", "cmake --install BUILD"])

    def test_a_machine_without_an_installation_for_it(self):
        self.refuse(self.deployment(), "--for", "arm64", installation=False,
                    says=["a bundle for arm64 needs an Armature that was built for it", "--installation"])

    def test_an_installation_for_another_machine(self):
        self.refuse(self.deployment(), "--for", "armhf",
                    says="bin/armature' is for amd64, expected one for armhf")

    def test_absolute_paths(self):
        policy = self.write("robot/hello.policy")
        self.refuse(self.deployment(more=f"network: {{listen: \"unix:a.sock\", policy: \"{policy}\"}}\n"),
                    says=["hello.yaml:3:", f"policy has the absolute path '{policy}'"])

    def test_files_of_the_system(self):
        self.refuse(self.deployment(), "--script", "/etc/hostname",
                    says="'/etc/hostname' belongs to the system")

    def test_files_that_count_from_the_working_directory(self):
        shutil.copy(JANUS / "janus.urdf", self.work)
        file = self.folder / "robot" / "pid.yaml"
        shutil.copytree(JANUS / "deployments", file.parent)
        told = self.bundle(file, "--set", "description=janus.urdf", code=1)
        self.assertIn("a file that counts from the working directory", told)
        self.assertIn("the check fails in the bundle, though it passes here", told)
        self.assertEqual(files_in(self.work), ["janus.urdf"])

    @unittest.skipIf(os.geteuid() == 0, "root reads everything")
    def test_files_that_cannot_be_read(self):
        self.write("robot/page/index.html").chmod(0)
        self.write("robot/hello.policy", "allow page read *\n")
        self.refuse(self.deployment(more="network: {listen: \"ws://127.0.0.1:0\", pages: page}\n"),
                    says=["page/index.html", "Permission denied"])

    def test_places_that_cannot_be_written(self):
        self.refuse(self.deployment(), "--out", "nowhere/bundle",
                    says=["nowhere' cannot be written: No such file or directory"])
        self.refuse(self.deployment(), "--out", "/proc/bundle", says="'/proc' cannot be written")

    def test_a_file_or_folder_of_others_in_its_place(self):
        for made in (lambda path: path.write_text(""), lambda path: path.mkdir()):
            place = self.folder / "taken"
            made(place)
            self.refuse(self.deployment(), "--out", place,
                        says=[f"'{place}' is there, and is no bundle of 'hello' that may be replaced",
                              "name another place by --out"])
            place.rmdir() if place.is_dir() else place.unlink()

    def test_an_application_that_cannot_be_a_name(self):
        file = self.deployment()
        file.write_text(file.read_text().replace("application: hello", "application: ../hello"))
        self.refuse(file, says="application '../hello' cannot name a bundle, expected letters")

    def test_a_signal_leaves_nothing(self):
        making = subprocess.Popen([PROGRAM, "bundle", self.deployment(), "--deb", "--installation", prefix],
                                  cwd=self.work, stderr=subprocess.PIPE, text=True)
        while making.poll() is None and not any(self.work.iterdir()):
            time.sleep(0.001)
        making.send_signal(signal.SIGINT)
        _, told = making.communicate(timeout=300)
        self.assertEqual(making.returncode, 1, told)
        self.assertIn("stopped by a signal: nothing is made", told)
        self.assertEqual(list(self.work.iterdir()), [])

    def test_an_unknown_machine(self):
        done = run(PROGRAM, "bundle", self.deployment(), "--for", "arm46", cwd=self.work)
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'arm64'?", done.stderr + done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
