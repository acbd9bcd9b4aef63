// SPDX-License-Identifier: Apache-2.0
// The demonstration of motions of the tool, as its script commands it.
#include <chrono>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/lua/script.hpp"
#include "tests/wam/arm.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

TEST(WamPathsScript, DrawsItsPathsJogsAndGoesHome) {
  std::string printed;
  lua::Options options;
  options.print = [&](std::string_view line) { printed += std::string(line) + "\n"; };
  std::ifstream file(WAM "/demo/paths.lua");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  base::Diagnostics diagnostics;
  const auto script = lua::parse_script(text, WAM "/demo/paths.lua", options, diagnostics);
  ASSERT_TRUE(script) << diagnostics.to_text();
  Arm arm("../demo/paths.yaml");
  arm.start();
  EXPECT_EQ(script->run(arm.application(), 100s, nullptr, diagnostics),
            exec::RunEnd::kStopRequested)
      << diagnostics.to_text();
  EXPECT_EQ(diagnostics.to_text(), "");
  EXPECT_EQ(arm.application().faults(), 0u);
  EXPECT_THAT(printed, HasSubstr("jogged by 0.0"));
  EXPECT_THAT(printed, HasSubstr(" m along the path of 2."));
}

}  // namespace
}  // namespace armature::wam
