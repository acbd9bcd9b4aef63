#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""armature_idl() in a project of its own: what is generated anew after which change.

usage: depends_test.py RCIDL SOURCE_DIR CMAKE
"""
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

RCIDL, SOURCE, CMAKE = sys.argv[1:4]

# Stands for find_package(armature); nothing is compiled here.
PROJECT = f"""
cmake_minimum_required(VERSION 3.25)
project(depends LANGUAGES CXX)
add_executable(armature::rcidl IMPORTED)
set_target_properties(armature::rcidl PROPERTIES IMPORTED_LOCATION "{RCIDL}")
add_library(armature::ride INTERFACE IMPORTED)
add_library(armature::types INTERFACE IMPORTED)
include("{SOURCE}/cmake/ArmatureIdl.cmake")
armature_idl(NAME parts IDL idl/wheel.idl idl/rover.idl NAMESPACE robot JSON)
"""
TYPES = "parts_idl/rover_types.hpp"
JSON = "parts_idl/rover.json"


class Depends(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source, self.build = Path(folder.name, "source"), Path(folder.name, "build")
        self.write("CMakeLists.txt", PROJECT)
        self.write("idl/wheel.idl", "struct Wheel { double radius; };\n")
        self.write("idl/rover.idl", 'import "wheel.idl";\ninterface Rover { struct Wheel left(); };\n')
        self.run_program(CMAKE, "-G", "Ninja", "-S", self.source, "-B", self.build)
        self.generate()

    def write(self, name, text):
        path = self.source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        before = path.stat().st_mtime_ns if path.exists() else 0
        path.write_text(text)
        while path.stat().st_mtime_ns == before:  # a file system may count in coarse steps
            time.sleep(0.001)
            path.touch()

    def run_program(self, *command):
        done = subprocess.run([str(each) for each in command], check=False, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def generate(self):
        return self.run_program("ninja", "-C", self.build, TYPES, "parts_idl/wheel_types.hpp")

    def text(self, name):
        return (self.build / name).read_text()

    def test_nothing_is_generated_a_second_time(self):
        self.assertIn("no work to do", self.generate())

    def test_options_reach_rcidl(self):
        self.assertIn("namespace robot {", self.text(TYPES))
        self.assertIn('"namespace": "robot"', self.text(JSON))

    def test_a_changed_file_is_generated_anew(self):
        self.write("idl/rover.idl", "interface Rover { void halt(); };\n")
        self.generate()
        self.assertIn("void halt()", self.text(TYPES))

    def test_so_is_what_imports_it(self):
        self.write("idl/wheel.idl", "struct Wheel { float radius; };\n")
        self.generate()
        self.assertIn("struct Wheel{float} left()", self.text(TYPES))
        self.assertIn("no work to do", self.generate())

    def test_a_change_without_consequence_is_looked_at_once(self):
        self.write("idl/wheel.idl", "struct Wheel { double radius; }; // a comment\n")
        self.assertIn("rover.idl", self.generate())
        self.assertIn("no work to do", self.generate())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
