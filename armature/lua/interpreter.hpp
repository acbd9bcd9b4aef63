// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/application.hpp"
#include "armature/inspect/status.hpp"
#include "armature/lua/course.hpp"

namespace armature::lua {

/// Whoever types lines for an Interpreter, and reads what they give.
/// @thread the controlling one
class Listener {
 public:
  virtual ~Listener() = default;

  /// A line that is printed, or a value.
  virtual void say(std::string_view line) = 0;
  /// A mistake or a loss: `error: ...`, `warning: ...`.
  virtual void complain(std::string_view text) = 0;
  /// A command was begun and is under way, or has ended.
  virtual void tell(const inspect::CommandStatus& command) = 0;
  /// Commands that are under way while somebody waits; takes the place of what it showed before.
  virtual void show_progress(const std::vector<inspect::CommandStatus>& commands) = 0;
  /// Nobody waits any more.
  virtual void end_progress() = 0;

  /// What runs is to end: asked again and again.
  virtual bool interrupted() const = 0;
  /// Likewise, and forgets it.
  virtual bool take_interrupt() = 0;
};

/// A state machine that typed lines defined.
struct MachineStatus {
  std::string name;
  std::string state;  ///< empty while it does not run
};

/// Whose lines are run, and how.
struct InterpreterOptions {
  bool simulated = false;           ///< the application's time
  std::size_t most_elements = 100;  ///< of a list that are said
};

/// Lua as the operator types it: the language of scripts, piece by piece, on the operator's behalf.
/// @thread the controlling one
class Interpreter {
 public:
  Interpreter() = default;
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;
  virtual ~Interpreter() = default;

  /// Whether more lines must follow until `text` is whole.
  virtual bool is_incomplete(const std::string& text) = 0;

  /// Runs `text`, waits included, and tells what it gives; false if there was a mistake, which was
  /// told.
  virtual bool run(const std::string& text) = 0;

  /// Lets time pass, and what `at` made run; false if an interrupt or `also` ended it before.
  /// Whoever gives `also` shows something: no progress of commands is shown then.
  virtual bool let_pass(base::Duration duration, const std::function<bool()>& also) = 0;
  /// Until all commands that were begun have ended. An interrupt cancels them, a second one ends
  /// the wait.
  virtual void wait_for_commands() = 0;
  /// False if none is under way.
  virtual bool cancel_commands() = 0;

  /// What is due runs; what has ended is told. False if the run has ended.
  virtual bool catch_up() = 0;

  /// In the order of their definition.
  virtual std::vector<MachineStatus> machines() const = 0;

  /// The names in a table of Lua's, such as `math`, in order; of the global one for an empty name.
  virtual std::vector<std::string> names_in(const std::string& table) = 0;
};

/// @param application, course, listener  outlive it
std::unique_ptr<Interpreter> make_interpreter(exec::Application& application, Course& course,
                                              Listener& listener,
                                              const InterpreterOptions& options);

}  // namespace armature::lua
