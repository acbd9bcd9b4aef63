// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armature::wam {

/// What is typed, or comes from another program, as the commands that it means.
class EmulatorInput {
 public:
  enum class Kind {
    kLines,  ///< a command is a line
    kKeys,   ///< a command is a key, or a line that a colon begins
  };
  explicit EmulatorInput(Kind kind);

  /// The commands that this completes, without their line ends; of a key the command that it stands
  /// for. A line beyond `kMostLetters` is cut.
  std::vector<std::string> take(std::string_view typed);

  /// A line is being typed.
  bool in_line() const { return state_ == State::kLine; }
  /// What there is of it.
  const std::string& line() const { return line_; }

  static constexpr std::size_t kMostLetters = 200;

 private:
  enum class State { kKeys, kLine, kEscape, kSequence };

  void take_key(char typed, std::vector<std::string>& commands);
  void take_letter(char typed, std::vector<std::string>& commands);

  const Kind kind_;
  State state_;
  std::string line_;
};

/// The keys and what they are for, a line.
std::string emulator_keys();

}  // namespace armature::wam
