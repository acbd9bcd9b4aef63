// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/script/internal/completion.hpp"
#include "armature/script/internal/course.hpp"
#include "armature/script/internal/interpreter.hpp"
#include "armature/script/internal/surface.hpp"

namespace armature::script::internal {

class Watch;

/// What the operator's lines mean: commands of the browser, values to show, Lua. Knows no terminal.
class TaskBrowser {
 public:
  /// @param duration  of the application's run, in its own time
  TaskBrowser(exec::Application& application, base::Duration duration,
              const platform::StopSignal* stop, bool simulated, Surface& surface);

  /// Does what a line says; waits as long as that takes.
  void take(std::string_view line);
  /// To be called while nobody has typed a line; false if the run has ended.
  bool idle() { return interpreter_.catch_up(); }
  /// The lines so far ask for more.
  bool wants_more() const { return !lines_.empty(); }
  void forget_lines() { lines_.clear(); }
  std::string prompt() const;
  Completion complete(std::string_view before_cursor);

  void stop() { course_.stop(); }
  bool has_ended() const { return course_.has_ended(); }
  exec::RunEnd end() const { return course_.end(); }
  /// Lines that were mistakes.
  std::size_t mistakes() const { return mistakes_; }

 private:
  using Words = std::vector<std::string>;
  struct Command {
    std::string_view name;
    void (TaskBrowser::*act)(const Words& arguments);
  };
  static const Command* find_command(std::string_view name);
  bool take_command(const std::string& line);
  bool take_item(const std::string& line);
  void take_lua(const std::string& text);
  struct Assignment;
  bool prepare(Assignment& assignment);

  void list(const Words& names);
  void help(const Words& subjects);
  void watch(const Words& words);
  void watch_in_place(const Watch& watch);
  void watch_by_lines(const Watch& watch);
  void threads(const Words& arguments);
  void faults(const Words& arguments);
  void start(const Words& names);
  void stop_components(const Words& names);
  void reset(const Words& names);
  void recover(const Words& names);
  void run(const Words& arguments);
  void wait(const Words& arguments);
  void cancel(const Words& arguments);
  void quit(const Words& arguments);

  using Transition = component::Outcome (exec::Application::*)(std::string_view);
  void change(const Words& names, Transition transition);
  Words all_in(component::State state) const;
  bool takes_nothing(std::string_view command, const Words& arguments);
  void mistake(std::string_view text);
  Paper paper() const { return surface_.paper(); }
  double seconds() const;

  exec::Application& application_;
  Surface& surface_;
  bool simulated_;
  base::Time begin_;
  Course course_;
  Interpreter interpreter_;
  std::string lines_;  ///< of a statement that is not whole yet
  std::size_t mistakes_ = 0;
};

}  // namespace armature::script::internal
