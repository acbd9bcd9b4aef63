// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/vocabulary.hpp"
#include "armature/lua/interpreter.hpp"

namespace armature::browser::internal {

/// What lines mean that are no commands of the task browser: values to set, calls, statements.
class Language {
 public:
  virtual ~Language() = default;

  virtual const Vocabulary& vocabulary() const = 0;

  /// Whether a line is of this language although it begins with the name of a command.
  /// @param behind  what follows the name: `= 5` of `run = 5`
  virtual bool goes_on(std::string_view behind) const = 0;
  /// Whether a line cannot be the name of something to show.
  virtual bool is_statement(std::string_view line) const = 0;
  /// Does what a line says that names nothing to show; tells of mistakes.
  virtual void take(std::string_view line) = 0;

  /// The lines so far ask for more.
  virtual bool wants_more() const { return false; }
  virtual void forget_lines() {}

  /// The name of a component or item that `text` spells.
  virtual std::string plain(std::string_view text) const = 0;
  /// How lines spell the name of a component.
  virtual std::string spelled(const std::string& component) const = 0;

  /// The names in a table, such as `math`; the global ones for an empty name.
  virtual std::vector<std::string> names_in(const std::string& table) = 0;
  /// State machines that lines defined.
  virtual std::vector<lua::MachineStatus> machines() const { return {}; }
};

}  // namespace armature::browser::internal
