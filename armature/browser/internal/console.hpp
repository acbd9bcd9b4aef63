// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "armature/browser/internal/completion.hpp"
#include "armature/browser/internal/surface.hpp"

namespace armature::browser::internal {

/// Whoever does what an operator's lines say.
class LineTaker {
 public:
  virtual ~LineTaker() = default;

  /// Does what a line says; waits as long as that takes.
  virtual void take(std::string_view line) = 0;
  /// To be called while nobody has typed a line; false if there is nothing to command any more.
  virtual bool idle() = 0;
  /// The lines so far ask for more.
  virtual bool wants_more() const { return false; }
  virtual void forget_lines() {}
  virtual std::string prompt() const = 0;
  virtual Completion complete(std::string_view before_cursor) = 0;
  /// The operator has no more to say.
  virtual void stop() = 0;
  virtual bool has_ended() const = 0;
  /// Lines that were mistakes.
  virtual std::size_t mistakes() const = 0;
};

class Terminal;
class PipedLines;

/// The standard input and output: a terminal, where lines are edited, or pipes.
class Console {
 public:
  Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  Surface& surface() { return *surface_; }
  const Surface& surface() const { return *surface_; }
  /// Gives `taker` line after line until it has ended.
  /// @param quitting  what `quit` does, for people: `stops the application`
  /// @return lines that were mistakes, if no terminal was there to see that
  std::size_t run(LineTaker& taker, std::string_view quitting);
  /// What others write to the terminal, whole lines, goes above the line that is being typed.
  void beside(const std::function<void()>& write);
  /// Nobody will type another line.
  bool at_end() const;

 private:
  void run_at_terminal(LineTaker& taker, const std::string& quitting);
  std::size_t run_by_pipe(LineTaker& taker);

  Terminal* terminal_ = nullptr;  ///< if the surface is one
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<PipedLines> lines_;  ///< if it is none
};

}  // namespace armature::browser::internal
