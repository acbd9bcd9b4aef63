// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/completion.hpp"
#include "armature/browser/internal/console.hpp"
#include "armature/browser/internal/listener.hpp"
#include "armature/browser/internal/local_robot.hpp"
#include "armature/browser/internal/shared_commands.hpp"
#include "armature/browser/internal/surface.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/course.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

class Watch;

/// What the operator's lines mean: commands of the browser, values to show, Lua. Knows no terminal.
class TaskBrowser final : public LineTaker, private SharedCommands {
 public:
  /// @param duration  of the application's run, in its own time
  TaskBrowser(exec::Application& application, base::Duration duration,
              const platform::StopSignal* stop, bool simulated, Surface& surface);

  void take(std::string_view line) override;
  /// False if the run has ended.
  bool idle() override { return interpreter_->catch_up(); }
  bool wants_more() const override { return !lines_.empty(); }
  void forget_lines() override { lines_.clear(); }
  std::string prompt() const override;
  Completion complete(std::string_view before_cursor) override;

  void stop() override { course_.stop(); }
  bool has_ended() const override { return course_.has_ended(); }
  std::size_t mistakes() const override { return SharedCommands::mistakes(); }
  exec::RunEnd end() const { return course_.end(); }

 private:
  struct Command {
    std::string_view name;
    void (*act)(TaskBrowser& browser, const Words& arguments);
  };
  /// Not a pointer to a member: those of a base class at another address confuse GCC's sanitizer.
  template <auto Member>
  static void act(TaskBrowser& browser, const Words& arguments) {
    (browser.*Member)(arguments);
  }
  static const Command* find_command(std::string_view name);
  bool take_command(const std::string& line);
  bool take_item(const std::string& line);
  void take_lua(const std::string& text);
  struct ItemAssignment;
  bool prepare(ItemAssignment& assignment);

  void list(const Words& names);
  void watch(const Words& words);
  void watch_in_place(const Watch& watch);
  void watch_by_lines(const Watch& watch);
  void run(const Words& arguments);
  void wait(const Words& arguments);
  void cancel(const Words& arguments);
  void quit(const Words& arguments);

  double seconds() const;

  exec::Application& application_;
  LocalRobot robot_here_;
  bool simulated_;
  base::Time begin_;
  lua::Course course_;
  Listener listener_;
  std::unique_ptr<lua::Interpreter> interpreter_;
  std::string lines_;  ///< of a statement that is not whole yet
};

}  // namespace armature::browser::internal
