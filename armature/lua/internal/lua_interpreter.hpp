// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/lua/internal/components.hpp"
#include "armature/lua/internal/sandbox.hpp"
#include "armature/lua/internal/schedule.hpp"
#include "armature/lua/internal/sources.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::lua::internal {

/// An Interpreter with a Lua of its own, without a limit of time: whoever types interrupts it.
class LuaInterpreter final : public Interpreter {
 public:
  LuaInterpreter(exec::Application& application, Course& course, Listener& listener,
                 const InterpreterOptions& options);
  ~LuaInterpreter() override;

  bool is_incomplete(const std::string& text) override;
  bool run(const std::string& text) override;
  bool let_pass(base::Duration duration, const std::function<bool()>& also) override;
  void wait_for_commands() override;
  bool cancel_commands() override;
  bool catch_up() override;
  std::vector<MachineStatus> machines() const override;
  std::vector<std::string> names_in(const std::string& table) override;

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
  Listener& listener_;
  InterpreterOptions options_;
  Access access_;
  std::function<void(std::string_view)> print_;
  Sources sources_;
  Sandbox sandbox_;
  Schedule schedule_;
  std::vector<Begun> begun_;
  base::Time next_look_{};      ///< at the application while Lua runs, on the machine's clock
  base::Time next_progress_{};  ///< likewise: when progress is shown again
  bool several_lines_ = false;
  bool quiet_ = false;
};

}  // namespace armature::lua::internal
