// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/session.hpp"
#include "armature/remote/peer_view.hpp"

namespace armature::browser::internal {

/// A session at an application of another process, whose connection may be lost and come back.
/// Commands that were begun in it end with the connection.
class RemoteSession final : public Session {
 public:
  /// Lets time pass.
  using Pause = std::function<void(base::Duration)>;

  /// @param view, answers  outlive it
  RemoteSession(remote::PeerView& view, Answers& answers, Pause pause);

  std::string prompt() const override { return name_ + "> "; }
  bool keep_up() override;
  /// A line that is typed while there is no connection waits for it.
  bool is_ready() override;
  void end_line() override;
  bool simulated() const override { return false; }
  bool tells_ages() const override { return true; }
  double stamp(base::Duration passed) const override;
  std::string interrupted_text() const override { return "interrupted"; }
  bool let_pass(base::Duration duration, const std::function<bool()>& also) override;
  void wait_for_commands() override;
  bool cancel_commands() override;
  void stop() override;
  bool has_ended() const override { return ended_; }

  remote::PeerView& view() { return view_; }
  /// Begins a command, whose end is told whenever it comes.
  void begin(const std::string& component, const std::string& command,
             const std::vector<std::string>& arguments);

 private:
  void note_connection();
  /// Finds out who answers there.
  void greet();
  /// An application that was there is not there now.
  bool is_away() const { return !view_.connected() || (had_application_ && !has_application_); }
  /// Asks how the commands fare that were begun, and tells of those that have ended.
  void follow_commands();
  /// Likewise of one; true if it has ended.
  bool follow(inspect::CommandStatus& command);
  void show_progress();

  remote::PeerView& view_;
  Answers& answers_;
  Pause pause_;
  std::string name_;  ///< of the application
  std::vector<inspect::CommandStatus> begun_;
  base::Time next_look_{};  ///< at the commands
  bool has_application_ = false;
  bool had_application_ = false;
  bool was_lost_ = false;    ///< and has not come back yet
  bool is_another_ = false;  ///< it may have been started anew since the commands were begun
  bool ended_ = false;
};

}  // namespace armature::browser::internal
