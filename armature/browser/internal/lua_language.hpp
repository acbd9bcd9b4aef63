// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/language.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

/// Lua, in which a value that is set may have its unit behind it, and names of components are
/// spelled as they are.
/// @thread the controlling one
class LuaLanguage final : public Language {
 public:
  /// All outlive it.
  LuaLanguage(exec::Application& application, inspect::View& view, lua::Interpreter& interpreter,
              Answers& answers)
      : application_(application),
        view_(view, *this),
        interpreter_(interpreter),
        answers_(answers) {}

  const Vocabulary& vocabulary() const override { return lua_vocabulary(); }
  bool goes_on(std::string_view behind) const override;
  /// What names nothing to show turns out when it is looked for.
  bool is_statement(std::string_view) const override { return false; }
  void take(std::string_view line) override;
  bool wants_more() const override { return !lines_.empty(); }
  void forget_lines() override { lines_.clear(); }
  std::string plain(std::string_view text) const override;
  std::string spelled(const std::string& component) const override;
  std::vector<std::string> names_in(const std::string& table) override {
    return interpreter_.names_in(table);
  }
  std::vector<lua::MachineStatus> machines() const override { return interpreter_.machines(); }

 private:
  struct ItemAssignment;
  bool prepare(ItemAssignment& assignment);
  std::string line_in_lua(std::string_view text) const;
  void show(const ItemAssignment& assignment);

  exec::Application& application_;
  SpelledView view_;
  lua::Interpreter& interpreter_;
  Answers& answers_;
  std::string lines_;  ///< of a statement that is not whole yet
};

}  // namespace armature::browser::internal
