// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/remote_session.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/browser/internal/command_texts.hpp"
#include "armature/browser/internal/plain_values.hpp"
#include "armature/platform/clock.hpp"

namespace armature::browser::internal {
namespace {

using namespace std::chrono_literals;
using remote::CommandStatus;

/// Of commands that are under way.
constexpr base::Duration kFollowPeriod = 100ms;
constexpr base::Duration kStep = 20ms;
/// A command that has only to be accepted has ended so soon.
constexpr base::Duration kSoon = 50ms;
/// A line that is typed while there is no connection waits so long for it.
constexpr base::Duration kReconnectionLimit = 3s;

}  // namespace

RemoteSession::RemoteSession(RemoteRobot& robot, Answers& answers, Pause pause)
    : robot_(robot), answers_(answers), pause_(std::move(pause)), name_(robot.address()) {
  robot_.take_changes();
  greet();
}

// --- the connection ------------------------------------------------------------------------------

/// Whoever may not read the application's own name still sees where it is.
void RemoteSession::greet() {
  try {
    has_application_ = robot_.has_application();
    if (!has_application_ && !had_application_) {
      answers_.surface().complain("note: a node answers at " + robot_.address() +
                                  ", but no application that can be browsed; "
                                  "`list` shows what it hosts");
    }
    if (!has_application_) return;
    had_application_ = true;
    if (std::exchange(was_lost_, false)) {
      answers_.surface().complain("connected to " + robot_.address() + " again");
    }
    name_ = robot_.status().name;
  } catch (const NoAnswer& problem) {
    answers_.surface().complain("warning: " + std::string(problem.what()));
  }
}

void RemoteSession::note_connection() {
  bool back = false;
  for (const ride::PeerChange& change : robot_.take_changes()) {
    back = change.connected;
    robot_.forget();
    if (change.connected) continue;
    was_lost_ = is_another_ = true;
    has_application_ = false;
    answers_.surface().complain("the connection to " + robot_.address() +
                                " is lost: " + harmless(change.text) + "; trying again");
  }
  if (back) greet();
}

bool RemoteSession::is_ready() {
  note_connection();
  for (base::Duration passed{}; is_away() && passed < kReconnectionLimit; passed += kStep) {
    pause_(kStep);
    note_connection();
  }
  if (!is_away()) return true;
  const auto there = robot_.wait_until_connected(base::Duration::zero());
  answers_.mistake(there ? "the process at " + robot_.address() + " has no application now"
                         : harmless(there.error()));
  return false;
}

// --- time ----------------------------------------------------------------------------------------

bool RemoteSession::keep_up() {
  note_connection();
  follow_commands();
  return !ended_;
}

double RemoteSession::stamp(base::Duration passed) const { return base::to_seconds(passed); }

bool RemoteSession::let_pass(base::Duration duration, const std::function<bool()>& also) {
  for (base::Duration passed{}; passed < duration; passed += kStep) {
    if (answers_.surface().interrupted() || (also && also()) || !keep_up()) return false;
    pause_(std::min(kStep, duration - passed));
  }
  return !answers_.surface().interrupted() && !(also && also());
}

/// Says once what becomes of commands that are under way.
void RemoteSession::stop() {
  if (ended_) return;
  note_connection();
  ended_ = true;
  for (const CommandStatus& command : begun_) {
    answers_.say(command.command +
                 ": cancelled, because the connection of the client that began it has ended");
  }
}

// --- commands that were begun --------------------------------------------------------------------

void RemoteSession::begin(const std::string& component, const std::string& command,
                          const std::vector<std::string>& arguments) {
  CommandStatus begun = robot_.begin(component, command, arguments);
  for (base::Duration passed{}; !begun.ended && passed < kSoon; passed += kStep) {
    pause_(kStep);
    begun = robot_.follow(begun.handle);
  }
  if (!begun.ended) begun_.push_back(begun);
  answers_.say(fate_text(answers_.paper(), begun));
}

void RemoteSession::wait_for_commands() {
  bool cancelled = false;
  while (!begun_.empty() && !ended_) {
    show_progress();
    if (!let_pass(kFollowPeriod, {}) && answers_.surface().take_interrupt() &&
        (std::exchange(cancelled, true) || !cancel_commands())) {
      break;
    }
  }
  answers_.surface().show("");
}

bool RemoteSession::cancel_commands() {
  for (const CommandStatus& command : begun_) robot_.cancel(command.handle);
  return !begun_.empty();
}

void RemoteSession::show_progress() {
  if (answers_.surface().live()) answers_.surface().show(progress_text(begun_));
}

void RemoteSession::end_line() {
  next_look_ = {};
  follow_commands();
}

void RemoteSession::follow_commands() {
  const base::Time now = platform::monotonic_now();
  if (begun_.empty() || now < next_look_ || is_away()) return;
  next_look_ = now + kFollowPeriod;
  std::erase_if(begun_, [&](CommandStatus& command) { return follow(command); });
  if (!is_away()) is_another_ = false;
}

bool RemoteSession::follow(CommandStatus& command) {
  try {
    command = robot_.follow(command.handle);
  } catch (const NoAnswer& problem) {
    if (!is_another_ || is_away()) return false;
    answers_.surface().show("");
    answers_.say(command.command + ": how it ended is not known: " + problem.what());
    return true;
  }
  if (!command.ended) return false;
  answers_.surface().show("");
  answers_.say(fate_text(answers_.paper(), command));
  return true;
}

}  // namespace armature::browser::internal
