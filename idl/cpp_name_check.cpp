// SPDX-License-Identifier: Apache-2.0
#include "idl/cpp_name_check.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "idl/cpp_words.hpp"

namespace armature::idl {
namespace {

bool is_cpp_name(std::string_view name) {
  const bool begins = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0;
  return begins && !is_cpp_word(name) && std::all_of(name.begin(), name.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
         });
}

/// Two things of one scope may not have one name.
class Scope {
 public:
  Scope(std::string where, base::Diagnostics& diagnostics)
      : where_(std::move(where)), diagnostics_(diagnostics) {}

  void add(const std::string& cpp_name, const std::string& what, const base::Location& where) {
    const auto [first, is_new] = what_.emplace(cpp_name, what);
    if (is_new || first->second == what) return;
    diagnostics_.error(
        where, what + " and " + first->second + " would both be '" + cpp_name + "' in " + where_,
        "rename one of them");
  }

 private:
  std::string where_;
  base::Diagnostics& diagnostics_;
  std::map<std::string, std::string> what_;
};

class NameChecker {
 public:
  NameChecker(const Program& program, const CppNames& names, base::Diagnostics& diagnostics)
      : program_(program), names_(names), diagnostics_(diagnostics) {}

  void run() {
    for (const Module& module : program_.modules()) {
      check_name_space(module);
      check_types(module);
      for (const Structure& structure : module.structures) check_members(structure);
      for (const Interface& interface : module.interfaces) check_operations(interface);
    }
  }

 private:
  void check_name_space(const Module& module) {
    const std::string name_space = names_.name_space(module);
    const std::vector<std::string> parts = parts_of_name_space(name_space);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool hides = parts[i] == "std" || (i > 0 && parts[i] == "armature");
      if (is_cpp_name(parts[i]) && !hides) continue;
      diagnostics_.error(
          {module.file, 0, 0},
          "'" + name_space + "' cannot be a namespace of C++; expected names like robot::vision",
          "choose one with --namespace NAME");
      return;
    }
  }

  void check_types(const Module& module) {
    Scope scope("namespace " + names_.name_space(module), diagnostics_);
    for (const Enumeration& each : module.enumerations) {
      scope.add(names_.type(each.name), "'" + each.name + "'", each.where);
    }
    for (const Structure& each : module.structures) {
      scope.add(names_.type(each.name), "'" + each.name + "'", each.where);
    }
    for (const Interface& each : module.interfaces) {
      const std::string made = " of interface '" + each.name + "'";
      scope.add(names_.placeholder(each), "the placeholder" + made, each.where);
      scope.add(names_.service(each), "the service" + made, each.where);
      scope.add(names_.constant(each), "the description" + made, each.where);
      scope.add(names_.constant(each) + "Declarations", "the declarations" + made, each.where);
    }
  }

  void check_members(const Structure& structure) {
    Scope scope("'" + structure.name + "'", diagnostics_);
    for (const Field& member : structure.members) {
      scope.add(names_.member(member.name), "member '" + member.name + "'", member.where);
    }
  }

  void check_operations(const Interface& interface) {
    Scope scope("the classes of interface '" + interface.name + "'", diagnostics_);
    for (const EventName& event : interface.events) {
      scope.add(names_.handler(event.name), "the handler of event '" + event.name + "'",
                event.where);
    }
    for (const Operation& operation : interface.operations) {
      scope.add(names_.operation(interface, operation.name), "operation '" + operation.name + "'",
                operation.where);
      check_parameters(operation);
    }
  }

  void check_parameters(const Operation& operation) {
    Scope scope("operation '" + operation.name + "'", diagnostics_);
    const std::vector<std::string> cpp_names = names_.parameters(operation.parameters);
    for (std::size_t i = 0; i < cpp_names.size(); ++i) {
      const Field& parameter = operation.parameters[i];
      if (parameter.name.empty()) continue;
      scope.add(cpp_names[i], "parameter '" + parameter.name + "'", parameter.where);
    }
  }

  const Program& program_;
  const CppNames& names_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

void check_cpp_names(const Program& program, const CppNames& names,
                     base::Diagnostics& diagnostics) {
  NameChecker(program, names, diagnostics).run();
}

}  // namespace armature::idl
