// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a small robot and what a script makes of it.

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/lua/script.hpp"
#include "armature/testing/small_robot.hpp"

namespace armature::lua::test {

using namespace testing::small_robot;

class Bench final : public SmallRobot {
 public:
  using SmallRobot::SmallRobot;

  exec::RunEnd ended() const { return ended_; }

  /// What is wrong with the script `robot.lua`; what it printed is in `lines`.
  std::string run(std::string_view text, base::Duration duration = 10s) {
    Options options;
    options.time_limit = time_limit;
    options.memory_limit = memory_limit;
    options.print = [this](std::string_view line) { lines.emplace_back(line); };
    base::Diagnostics diagnostics;
    const auto script = parse_script(text, path, options, diagnostics);
    if (diagnostics.ok()) {
      ended_ = script->run(application(), duration, nullptr, diagnostics);
    }
    return diagnostics.to_text();
  }

  std::vector<std::string> lines;
  std::string path = "robot.lua";
  base::Duration time_limit = 30s;
  std::size_t memory_limit = 64u << 20;

 private:
  exec::RunEnd ended_ = exec::RunEnd::kTimeUp;
};

}  // namespace armature::lua::test
