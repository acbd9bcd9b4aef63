// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/base/time.hpp"
#include "armature/component/command.hpp"
#include "armature/script/internal/components.hpp"
#include "armature/script/internal/course.hpp"
#include "armature/script/internal/sandbox.hpp"
#include "armature/script/internal/schedule.hpp"
#include "armature/script/internal/sources.hpp"
#include "armature/script/internal/surface.hpp"

namespace armature::script::internal {

/// Lua as the operator types it: the language of scripts, piece by piece, on the operator's behalf.
class Interpreter {
 public:
  Interpreter(exec::Application& application, Course& course, Surface& surface, bool simulated);
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;
  ~Interpreter();

  /// Whether more lines must follow until `text` is whole.
  bool is_incomplete(const std::string& text);

  /// Runs `text`, waits included, and writes what it gives; false if there was a mistake, which was
  /// told.
  bool run(const std::string& text);

  /// Lets time pass, and what `at` made run; false if Ctrl-C or `also` ended it before. Who gives
  /// `also` shows something himself: no progress of commands.
  bool let_pass(base::Duration duration, const std::function<bool()>& also = {});
  /// Until all commands that were begun have ended. Ctrl-C cancels them, a second one ends the
  /// wait.
  void wait_for_commands();
  /// False if there is none.
  bool cancel_commands();

  /// What is due runs; what has ended is told. False if the run has ended.
  bool catch_up();

  const Machines& machines() const { return schedule_.machines(); }

  /// The names in a table of Lua's, such as `math`; of the global one for an empty name.
  std::vector<std::string> names_in(const std::string& table);

 private:
  struct Begun {
    std::string name;
    component::CommandHandle* command;
    int reference;  ///< keeps it
  };

  static int show_results(lua_State* lua);
  void note_begun(lua_State* lua, const std::string& name);
  void show_result(lua_State* lua, int index);
  void show_command(const std::string& name, const component::CommandHandle& command);
  void tell_ended();
  void show_progress();
  void tell(const base::Diagnostic& mistake);
  std::string reason_to_end();
  bool compile_line(lua_State* lua, const std::string& text);
  lua_State* begin(const std::string& text);
  /// One wait of the part or of the operator; false if it is over.
  bool wait_until(base::Time until, const std::function<bool()>& also);
  bool follow(const lua_State* part);

  exec::Application& application_;
  Course& course_;
  Surface& surface_;
  bool simulated_;
  Access access_;
  std::function<void(std::string_view)> print_;
  Sources sources_;
  Sandbox sandbox_;
  Schedule schedule_;
  std::vector<Begun> begun_;
  base::Time next_look_{};  ///< on the machine's clock
  bool several_lines_ = false;
  bool quiet_ = false;
};

}  // namespace armature::script::internal
