// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_input.hpp"

#include <array>
#include <utility>

namespace armature::wam {
namespace {

struct Key {
  char letter;
  const char* command;
  const char* name;
};

/// Small letters only: a terminal sends capitals for the arrow keys.
constexpr auto kKeys = std::to_array<Key>({{'e', "estop", "E-stop"},
                                           {'r', "release", "release"},
                                           {'i', "idle", "Shift+Idle"},
                                           {'a', "activate", "Shift+Activate"},
                                           {'h', "home", "home"},
                                           {'?', "help", "help"},
                                           {'q', "quit", "quit"}});

constexpr char kEscape = '\x1b';
constexpr bool is_line_end(char typed) { return typed == '\n' || typed == '\r'; }
constexpr bool is_backspace(char typed) { return typed == '\x7f' || typed == '\b'; }
constexpr bool is_letter(char typed) { return typed >= ' ' && typed <= '~'; }

}  // namespace

EmulatorInput::EmulatorInput(Kind kind)
    : kind_(kind), state_(kind == Kind::kLines ? State::kLine : State::kKeys) {}

std::vector<std::string> EmulatorInput::take(std::string_view typed) {
  std::vector<std::string> commands;
  for (const char each : typed) {
    if (state_ == State::kLine) {
      take_letter(each, commands);
    } else {
      take_key(each, commands);
    }
  }
  return commands;
}

/// Arrow keys and their like send several letters, which are no keys of ours: ESC [ ... letter.
void EmulatorInput::take_key(char typed, std::vector<std::string>& commands) {
  if (state_ == State::kSequence) {
    if (typed >= '@' && typed <= '~') state_ = State::kKeys;
    return;
  }
  if (std::exchange(state_, State::kKeys) == State::kEscape && (typed == '[' || typed == 'O')) {
    state_ = State::kSequence;
    return;
  }
  if (typed == kEscape) state_ = State::kEscape;
  if (typed == ':') state_ = State::kLine;
  for (const Key& key : kKeys) {
    if (key.letter == typed) commands.emplace_back(key.command);
  }
}

void EmulatorInput::take_letter(char typed, std::vector<std::string>& commands) {
  const bool keys = kind_ == Kind::kKeys;
  if (is_line_end(typed)) {
    if (line_.find_first_not_of(" \t") != std::string::npos) commands.push_back(line_);
    line_.clear();
    if (keys) state_ = State::kKeys;
  } else if (keys && typed == kEscape) {
    line_.clear();
    state_ = State::kEscape;
  } else if (keys && is_backspace(typed)) {
    if (!line_.empty()) line_.pop_back();
  } else if ((is_letter(typed) || typed == '\t') && line_.size() < kMostLetters) {
    line_ += typed;
  }
}

std::string emulator_keys() {
  std::string all;
  for (const Key& key : kKeys) all += std::string(1, key.letter) + " " + key.name + "  ";
  return all + ": line";
}

}  // namespace armature::wam
