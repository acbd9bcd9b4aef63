// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_screen.hpp"

#include <chrono>
#include <cstdio>

#include "armature/base/seconds.hpp"
#include "armature/platform/terminal.hpp"
#include "robots/wam/emulator/emulator_report.hpp"

namespace armature::wam {
namespace {

constexpr base::Duration kBetween = std::chrono::milliseconds(200);
constexpr const char* kEraseLine = "\x1b[K";

void print(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

void EmulatorScreen::say(const std::string& text) {
  erase();
  print(text + "\n");
  std::fflush(stderr);
}

void EmulatorScreen::show(const EmulatorState& state, const std::string& prompt) {
  if (!terminal_) return;
  const base::Duration passed = state.time - shown_at_;
  if (shown_ && prompt == prompt_ && passed < kBetween) return;
  const double rate = static_cast<double>(state.frames - last_.frames) / base::to_seconds(passed);
  const auto width =
      static_cast<std::size_t>(platform::terminal_width(platform::kStandardError, 80));
  erase();
  for (const std::string& line : status_lines(state, rate)) print(line.substr(0, width - 1) + "\n");
  print(prompt.substr(0, width - 1));
  std::fflush(stderr);
  shown_ = true;
  prompt_ = prompt;
  shown_at_ = state.time;
  last_ = state;
}

void EmulatorScreen::erase() {
  if (!shown_) return;
  print("\r" + std::string(kEraseLine));
  for (std::size_t i = 0; i < kStatusLines; ++i) print("\x1b[A" + std::string(kEraseLine));
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace armature::wam
