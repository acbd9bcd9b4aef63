// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a screen that remembers what the task browser wrote, with a keyboard.

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/browser/internal/local_browsing.hpp"
#include "armature/testing/small_robot.hpp"

namespace armature::browser::test {

using namespace testing::small_robot;

class Screen final : public internal::Surface {
 public:
  internal::Paper paper() const override { return {width, colour}; }
  bool live() const override { return is_live; }
  void say(std::string_view text) override { lines.emplace_back(text); }
  void complain(std::string_view text) override { lines.emplace_back(text); }
  void show(std::string_view text) override {
    if (!text.empty()) shown.emplace_back(text);
  }
  bool interrupted() const override {
    if (asks_until_interrupt > 0 && --asks_until_interrupt == 0) interrupt = true;
    return interrupt;
  }
  bool take_interrupt() override { return std::exchange(interrupt, false); }
  void begin_keys() override { hears_keys = true; }
  bool take_key() override { return hears_keys && asks_until_key > 0 && --asks_until_key == 0; }
  void end_keys() override { hears_keys = false; }

  std::size_t width = 80;
  bool colour = false;
  bool is_live = false;
  std::vector<std::string> lines;
  std::vector<std::string> shown;
  mutable int asks_until_interrupt = 0;  ///< Ctrl-C comes at the so-many-th look; 0: never
  mutable bool interrupt = false;
  int asks_until_key = 0;
  bool hears_keys = false;
};

/// The task browser on the small robot, in simulated time unless said otherwise.
class Desk {
 public:
  explicit Desk(bool simulated = true)
      : bench(simulated), local(bench.application(), 1000s, nullptr, simulated, screen) {
    browser.idle();
  }

  /// What typing `text`, of one line or several, gives.
  std::string type(std::string_view text) {
    screen.lines.clear();
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      browser.take(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    std::string all;
    for (const std::string& line : screen.lines) all += (all.empty() ? "" : "\n") + line;
    return all;
  }

  SmallRobot bench;
  Screen screen;
  internal::LocalBrowsing local;
  internal::TaskBrowser& browser = local.browser;
};

}  // namespace armature::browser::test
