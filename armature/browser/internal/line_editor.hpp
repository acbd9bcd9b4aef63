// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "armature/browser/internal/completion.hpp"
#include "armature/browser/internal/display.hpp"

namespace armature::browser::internal {

/// What a line editor asks while somebody types.
struct Typing {
  std::function<bool()> idle;         ///< called again and again; false: nobody reads on
  std::function<bool()> interrupted;  ///< Ctrl-C came
  std::function<void()> forget_interrupt;
  std::function<Completion(std::string_view before_cursor)> complete;
};

/// Lines typed at a terminal, with history and completion. Uses the standard input and output.
class LineEditor {
 public:
  enum class Outcome { kLine, kInterrupted, kEnd };

  /// @param history_file  kept from run to run; empty: not kept
  LineEditor(Typing typing, std::string history_file);
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;
  ~LineEditor();

  /// @param line  receives what was typed, also of a line that was interrupted
  Outcome read(const std::string& prompt, const Paper& paper, std::string& line);

  /// Writes something above the line that is being typed, if one is.
  void beside(const std::function<void()>& write);

  struct State;  ///< what libedit's own functions are given

 private:
  std::unique_ptr<State> state_;
};

/// Where lines are kept from run to run; empty if there is no place for it.
std::string history_file();

}  // namespace armature::browser::internal
