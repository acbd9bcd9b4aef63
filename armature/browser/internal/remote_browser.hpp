// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/browser/internal/console.hpp"
#include "armature/browser/internal/remote_robot.hpp"
#include "armature/browser/internal/shared_commands.hpp"

namespace armature::browser::internal {

class Watch;

/// What the operator's lines mean to an application of another process: commands of the browser,
/// values to show and to set, calls. Knows no terminal.
class RemoteBrowser final : public LineTaker, private SharedCommands {
 public:
  /// Lets time pass.
  using Pause = std::function<void(base::Duration)>;

  RemoteBrowser(RemoteRobot& robot, Surface& surface, Pause pause);

  void take(std::string_view line) override;
  bool idle() override;
  std::string prompt() const override { return name_ + "> "; }
  Completion complete(std::string_view before_cursor) override;
  void stop() override;
  bool has_ended() const override { return ended_; }
  std::size_t mistakes() const override { return SharedCommands::mistakes(); }

 private:
  struct Command {
    std::string_view name;
    void (*act)(RemoteBrowser& browser, const Words& arguments);
  };
  /// Not a pointer to a member: those of a base class at another address confuse GCC's sanitizer.
  template <auto Member>
  static void act(RemoteBrowser& browser, const Words& arguments) {
    (browser.*Member)(arguments);
  }
  static const Command* find_command(std::string_view name);
  void take_words(const std::string& line);
  bool take_command(const std::string& line);
  void take_call(const std::string& line);
  void take_assignment(const Assignment& assignment);
  void take_item(const std::string& line);

  void watch(const Words& words);
  void watch_in_place(const Watch& watch);
  void watch_by_lines(const Watch& watch);
  void wait(const Words& arguments);
  void cancel(const Words& arguments);
  void quit(const Words& arguments);

  void note_connection();
  /// Finds out who answers there.
  void greet();
  /// A robot that was there is not there now.
  bool is_away() const { return !there_.connected() || (had_application_ && !has_application_); }
  bool wait_for_connection();
  /// Asks how the commands fare that were begun, and tells of those that have ended.
  void follow_commands();
  void show_progress();
  bool cancel_commands();
  /// False if Ctrl-C ended it early, or `also` did.
  bool let_pass(base::Duration duration, const std::function<bool()>& also = {});

  RemoteRobot& there_;
  Pause pause_;
  std::string name_;  ///< of the application
  std::vector<remote::CommandStatus> begun_;
  base::Time next_look_{};  ///< at the commands
  bool has_application_ = false;
  bool had_application_ = false;
  bool was_lost_ = false;    ///< and has not come back yet
  bool is_another_ = false;  ///< it may have been started anew since the commands were begun
  bool ended_ = false;
};

}  // namespace armature::browser::internal
