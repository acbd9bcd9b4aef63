// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "idl/model.hpp"

namespace armature::idl {

/// How things of the language are named in generated TypeScript: as they are, but for names that
/// TypeScript or the generated code has already, which get a `_` behind them, and a `2` where they
/// end with one, until nothing else has that name.
class TypescriptNames {
 public:
  explicit TypescriptNames(const Program& program);

  /// By which a module's types are known in another one.
  std::string module(const std::string& name) const;
  /// A struct, event or enum, as its own module calls it.
  std::string type(const std::string& name) const;
  std::string placeholder(const Interface& interface) const;
  std::string service(const Interface& interface) const;
  std::string member(const Structure& structure, const std::string& name) const;
  std::string operation(const Interface& interface, const std::string& name) const;
  /// The placeholder's function that subscribes to an event.
  std::string handler(const std::string& event) const;
  /// The service's function that raises an event.
  std::string raiser(const Interface& interface, const std::string& event) const;
  /// The service's parameter behind all others.
  /// @param parameters  as this class names them
  std::string call(const std::vector<std::string>& parameters) const;
  /// Names of all parameters; those without one are `a`, `b`, `c` by their places.
  std::vector<std::string> parameters(const std::vector<Field>& parameters) const;

 private:
  std::set<std::string> declared_;  ///< types and modules, as the language names them
  std::map<std::string, std::string> modules_;
};

}  // namespace armature::idl
