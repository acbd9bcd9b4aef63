// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "idl/model.hpp"

namespace armature::idl {

/// How things of the language are named in generated C++: as they are, but for names that C++ or
/// the generated code has already, which get a `_` behind them. `_Name` and `a__b`, which C++ keeps
/// for itself, become `Name_` and `a_b`.
class CppNames {
 public:
  /// @param name_space  of all modules, `NAME` or `NAME::NAME`; none: each module has its own name
  CppNames(const Program& program, std::optional<std::string> name_space);

  std::string name_space(const Module& module) const { return name_space(module.name); }
  std::string name_space(const std::string& module) const;

  /// A struct, event or enum, as its own module calls it.
  std::string type(const std::string& name) const;
  std::string placeholder(const Interface& interface) const;
  std::string service(const Interface& interface) const;
  std::string constant(const Interface& interface) const;

  /// `kCatchUp`: its text is the name again, by the rules of ARMATURE_ENUM.
  std::string enumerator(const std::string& name) const;
  std::string member(const std::string& name) const;
  std::string operation(const Interface& interface, const std::string& name) const;
  /// The placeholder's function that subscribes to an event.
  std::string handler(const std::string& event) const;
  /// Names of all parameters; those without one are `a`, `b`, `c` by their places.
  std::vector<std::string> parameters(const std::vector<Field>& parameters) const;

 private:
  std::optional<std::string> name_space_;
  std::set<std::string, std::less<>> name_spaces_;  ///< the outermost of each module
  std::set<std::string, std::less<>> types_;
};

/// `robot::vision`: its parts.
std::vector<std::string> parts_of_name_space(std::string_view name_space);

}  // namespace armature::idl
