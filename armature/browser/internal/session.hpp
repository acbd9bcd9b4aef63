// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "armature/base/time.hpp"

namespace armature::browser::internal {

/// An operator's session at an application: its time, and the commands that lines began.
class Session {
 public:
  virtual ~Session() = default;

  /// What stands before a line.
  virtual std::string prompt() const = 0;

  /// To be called while nobody types a line; false if there is nothing to command any more.
  virtual bool keep_up() = 0;
  /// Whether the application is there for another line; otherwise that was told as a mistake.
  virtual bool is_ready() = 0;
  /// A line is done: what it ended is told.
  virtual void end_line() = 0;

  /// Whether time passes only as lines let it.
  virtual bool simulated() const = 0;
  /// Whether the age of an old value is told: of an application that somebody looks at from another
  /// process, beside whom no log runs.
  virtual bool tells_ages() const = 0;
  /// What a watch that has gone on for `passed` writes beside its values, in seconds.
  virtual double stamp(base::Duration passed) const = 0;
  /// `interrupted`, and when if time is the application's.
  virtual std::string interrupted_text() const = 0;

  /// Lets time pass; false if Ctrl-C, the session's end or `also` ended it before. Whoever gives
  /// `also` shows something: no progress of commands is shown then.
  virtual bool let_pass(base::Duration duration, const std::function<bool()>& also) = 0;
  /// Until all commands that were begun have ended. Ctrl-C cancels them, a second one ends the
  /// wait.
  virtual void wait_for_commands() = 0;
  /// False if none is under way.
  virtual bool cancel_commands() = 0;

  /// The operator has no more to say.
  virtual void stop() = 0;
  virtual bool has_ended() const = 0;
};

}  // namespace armature::browser::internal
