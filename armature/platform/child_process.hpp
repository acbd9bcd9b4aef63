// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::platform {

/// How a program is started.
struct ChildOptions {
  /// This process writes to its standard input and reads its standard output; else it has no input,
  /// and writes to `log`.
  bool piped = false;
  std::string log{};  ///< a file that takes its output and errors, emptied before; empty: ours
  /// It has a session of its own: what is typed at this terminal does not reach it, and it stays
  /// when this process ends.
  bool lasting = false;
};

/// A program that this process has started.
/// @thread one at a time
class ChildProcess {
 public:
  /// @param arguments  the program's path, then its arguments
  static base::Result<ChildProcess> start(const std::vector<std::string>& arguments,
                                          const ChildOptions& options = {});

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  /// Kills it, unless it is lasting.
  ~ChildProcess();

  int id() const { return id_; }
  /// To be waited for: readable when it has written or ended. -1 if it is not piped.
  int output() const { return output_; }
  /// What it has written since; empty: nothing yet. Nothing at all once its output has ended.
  std::optional<std::string> read();
  /// Waits until the program has taken all; false if it takes nothing any more.
  bool write(std::string_view text);

  void send(int signal) const;
  /// How it ended, once it has: its code, or 128 and the number of the signal that ended it.
  std::optional<int> exit_code();

 private:
  ChildProcess(int id, int input, int output, bool lasting);

  int id_ = 0;
  int input_ = -1;
  int output_ = -1;
  bool lasting_ = false;
  std::optional<int> exit_code_;
};

/// True while there is a process of this number.
bool process_lives(int id);

/// True while the process of this number, of whomever, runs with this word in its command line:
/// numbers are given again, words that nobody else uses are not.
bool process_has_argument(int id, std::string_view word);

/// To a process that need not be a child of this one.
void send_signal(int id, int signal);

/// The path of the program that this process runs.
std::string own_program();

}  // namespace armature::platform
