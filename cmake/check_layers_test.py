#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shows that check_layers.py refuses what it should, on small trees that break one rule each."""
import shutil
import tempfile
import unittest
from pathlib import Path

from check_layers import Tree

LAYERS = Path(__file__).with_name("layers.cmake")


class CheckLayers(unittest.TestCase):
    def setUp(self):
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        (self.root / "cmake").mkdir()
        shutil.copy(LAYERS, self.root / "cmake")
        self.write("ARCHITECTURE.md", "")

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text)

    def assert_refused(self, path, include, reason):
        self.write(path, f"#pragma once\n#include {include}\n")
        problems = list(Tree(self.root).problems())
        self.assertEqual(len(problems), 1, problems)
        self.assertTrue(problems[0].startswith(f"{path}:2: error: "), problems)
        self.assertIn(reason, problems[0])

    def assert_accepted(self, path, include):
        self.write(path, f"#include {include}\n")
        self.assertEqual(list(Tree(self.root).problems()), [])

    def test_a_lower_layer_does_not_include_a_higher_one(self):
        self.assert_refused("armature/component/ports/port.hpp", '"armature/deploy/plan.hpp"',
                            "component may use only base, rt, types")

    def test_a_higher_layer_includes_a_lower_one(self):
        self.assert_accepted("armature/component/ports/port.hpp", '"armature/rt/latest.hpp"')

    def test_one_robot_does_not_reach_into_deploy(self):
        self.assert_refused("robots/janus/aic/aic.cpp", '"armature/deploy/plan.hpp"', "robots may use")

    def test_one_robot_does_not_include_another(self):
        self.assert_refused("robots/janus/aic/aic.cpp", '"robots/wam/emulator/puck.hpp"',
                            "one robot does not use another")

    def test_a_robot_includes_itself(self):
        self.assert_accepted("robots/janus/aic/aic.cpp", '"robots/janus/aic/aic.hpp"')

    def test_a_library_does_not_include_a_robot(self):
        self.assert_refused("armature/sim/plant.cpp", '"robots/janus/aic/aic.hpp"',
                            "does not know the robots")

    def test_a_test_of_components_runs_them(self):
        self.assert_accepted("armature/general/filter_test.cpp", '"armature/exec/application.hpp"')
        self.assert_refused("armature/general/filter.cpp", '"armature/exec/application.hpp"',
                            "general may use")

    def test_a_test_of_what_knows_no_components_runs_none(self):
        self.assert_refused("armature/rt/lane_test.cpp", '"armature/exec/application.hpp"',
                            "rt may use")

    def test_a_product_does_not_include_testing(self):
        self.assert_refused("armature/cli/run.cpp", '"armature/testing/guard.hpp"', "cli may use")

    def test_what_tests_share_includes_testing(self):
        self.assert_accepted("armature/controllers/internal/test_joint.hpp",
                             '"armature/testing/harness.hpp"')

    def test_a_test_includes_testing(self):
        self.assert_accepted("armature/base/unit_test.cpp", '"armature/testing/guard.hpp"')

    def test_a_test_does_not_include_a_higher_layer(self):
        self.assert_refused("armature/rt/ring_test.cpp", '"armature/exec/engine.hpp"',
                            "rt may use only base, platform, testing")

    def test_internal_headers_belong_to_their_library(self):
        self.assert_refused("examples/hello/hello.cpp", '"armature/rt/internal/futex.hpp"',
                            "belongs to rt alone")

    def test_a_library_includes_its_own_internal_headers(self):
        self.assert_accepted("armature/rt/ring.cpp", '"armature/rt/internal/futex.hpp"')

    def test_the_interface_compiler_includes_only_base(self):
        self.assert_refused("idl/parser.hpp", '"armature/platform/file.hpp"', "idl may use only base")

    def test_the_interface_compiler_includes_itself(self):
        self.assert_accepted("idl/parser.cpp", '"idl/internal/token_reader.hpp"')

    def test_a_library_does_not_include_the_interface_compiler(self):
        self.assert_refused("armature/ride/node.hpp", '"idl/model.hpp"', "ride may use only")

    def test_a_public_header_of_the_interface_compiler_includes_no_third_party_header(self):
        self.assert_refused("idl/json_backend.hpp", "<nlohmann/json.hpp>", "internal/")

    def test_a_library_of_drives_is_one_like_those_of_armature(self):
        self.write("cmake/layers.cmake", 'set(ARMATURE_LAYERS "base:" "can: base" "canopen: base can" "robots: base can")')
        self.assert_accepted("drives/canopen/sdo.cpp", '"armature/can/bus.hpp"')
        self.assert_accepted("drives/canopen/pdo.cpp", '"drives/canopen/sdo.hpp"')
        self.assert_refused("drives/canopen/sdo.hpp", '"armature/exec/engine.hpp"', "canopen may use only base, can")
        self.write("drives/canopen/sdo.hpp", "#pragma once\n")
        self.assert_refused("armature/can/bus.hpp", '"drives/canopen/sdo.hpp"', "can may use only base")
        self.write("armature/can/bus.hpp", "#pragma once\n")
        self.assert_refused("drives/canopen/nmt.hpp", '"robots/janus/plant.hpp"', "does not know the robots")

    def test_a_library_without_a_place_is_refused(self):
        self.assert_refused("armature/magic/wand.hpp", '"armature/base/unit.hpp"',
                            "not in cmake/layers.cmake")

    def test_a_public_header_does_not_include_third_party_headers(self):
        self.assert_refused("armature/deploy/document.hpp", "<yaml-cpp/yaml.h>", "internal/")

    def test_neither_does_an_internal_header_that_a_public_one_includes(self):
        self.write("armature/deploy/document.hpp", '#include "armature/deploy/internal/node.hpp"\n')
        self.assert_refused("armature/deploy/internal/node.hpp", "<yaml-cpp/yaml.h>", "internal/")

    def test_sources_and_internal_headers_may_include_third_party_headers(self):
        self.assert_accepted("armature/deploy/internal/node.hpp", "<yaml-cpp/yaml.h>")
        self.assert_accepted("armature/deploy/document.cpp", "<yaml-cpp/yaml.h>")

    def test_eigen_and_the_standard_library_are_free_for_all(self):
        self.assert_accepted("armature/base/vector.hpp", "<Eigen/Core>")
        self.assert_accepted("armature/base/text.hpp", "<string>")

    def test_only_platform_includes_headers_of_the_operating_system(self):
        self.assert_accepted("armature/platform/thread.hpp", "<pthread.h>")
        self.assert_refused("armature/rt/loop.cpp", "<sys/mman.h>", "only armature/platform, guard and guardian")

    def test_what_a_raw_text_includes_is_its_own_affair(self):
        self.write("armature/cli/new.cpp",
                   'auto text = R"(\n#include "armature/testing/guard.hpp"\n)";\n')
        self.assertEqual(list(Tree(self.root).problems()), [])
        self.write("armature/cli/new.cpp",
                   'auto text = R"(\n)";\n#include "armature/testing/guard.hpp"\n')
        self.assertEqual([p.split(": ")[0] for p in Tree(self.root).problems()],
                         ["armature/cli/new.cpp:3"])

    def test_what_is_allowed_is_used(self):
        self.write("cmake/layers.cmake", 'set(ARMATURE_LAYERS "base:" "rt: base" "can: base rt")')
        self.write("armature/can/bus.cpp", '#include "armature/rt/ring.hpp"\n')
        self.assertEqual([problem.split("error: ")[1] for problem in Tree(self.root).unused()],
                         ["rt may use base, and does not: remove it there",
                          "can may use base, and does not: remove it there"])

    def test_the_map_says_the_same(self):
        self.write("cmake/layers.cmake", 'set(ARMATURE_LAYERS "base:" "rt: base" "can: base rt" "sim: base can rt")')
        self.write("ARCHITECTURE.md", "`can -> rt`; `sim ->\ncan`")
        self.assertEqual([problem.split("expected ")[1] for problem in Tree(self.root).untold()],
                         ["`sim -> can, rt`, as cmake/layers.cmake does"])

    def test_includes_are_whole_paths(self):
        self.assert_refused("armature/rt/ring.hpp", '"latest.hpp"', "whole path")


if __name__ == "__main__":
    unittest.main()
