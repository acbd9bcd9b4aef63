// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "idl/model.hpp"

namespace armature::idl {

/// How things of the language are named in generated C++: as they are, but for words that C++ or
/// the generated classes have already, which get a `_` behind them.
class CppNames {
 public:
  /// @param name_space  of all modules, `NAME` or `NAME::NAME`; empty: each module has its own name
  CppNames(const Program& program, std::string name_space);

  std::string name_space(const Module& module) const { return name_space(module.name); }
  std::string name_space(const std::string& module) const;

  /// A struct, event or generated class, as its own module calls it.
  std::string type(const std::string& name) const;
  std::string placeholder(const Interface& interface) const {
    return interface.name + "Placeholder";
  }
  std::string service(const Interface& interface) const { return interface.name + "Service"; }
  std::string constant(const Interface& interface) const { return "k" + interface.name; }

  std::string member(const std::string& name) const;
  std::string operation(const std::string& name) const;
  /// Names of all parameters; those without one are `a`, `b`, `c` by their places.
  std::vector<std::string> parameters(const std::vector<Field>& parameters) const;

 private:
  std::string name_space_;
  std::set<std::string, std::less<>> name_spaces_;  ///< the outermost of each module
  std::set<std::string, std::less<>> types_;
};

/// Finds names that C++ cannot have, or not beside each other.
void check_cpp_names(const Program& program, const CppNames& names, base::Diagnostics& diagnostics);

}  // namespace armature::idl
