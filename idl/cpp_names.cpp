// SPDX-License-Identifier: Apache-2.0
#include "idl/cpp_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace armature::idl {
namespace {

/// Words of C++20, and macros of its standard headers that a name may meet.
constexpr std::string_view kWords[] = {"alignas",
                                       "alignof",
                                       "and",
                                       "and_eq",
                                       "asm",
                                       "assert",
                                       "auto",
                                       "bitand",
                                       "bitor",
                                       "bool",
                                       "break",
                                       "case",
                                       "catch",
                                       "char",
                                       "char16_t",
                                       "char32_t",
                                       "char8_t",
                                       "class",
                                       "co_await",
                                       "co_return",
                                       "co_yield",
                                       "compl",
                                       "concept",
                                       "const",
                                       "const_cast",
                                       "consteval",
                                       "constexpr",
                                       "constinit",
                                       "continue",
                                       "decltype",
                                       "default",
                                       "delete",
                                       "do",
                                       "double",
                                       "dynamic_cast",
                                       "else",
                                       "enum",
                                       "EOF",
                                       "errno",
                                       "explicit",
                                       "export",
                                       "extern",
                                       "false",
                                       "float",
                                       "for",
                                       "friend",
                                       "goto",
                                       "if",
                                       "INFINITY",
                                       "inline",
                                       "int",
                                       "linux",
                                       "long",
                                       "mutable",
                                       "namespace",
                                       "NAN",
                                       "new",
                                       "noexcept",
                                       "not",
                                       "not_eq",
                                       "NULL",
                                       "nullptr",
                                       "offsetof",
                                       "operator",
                                       "or",
                                       "or_eq",
                                       "private",
                                       "protected",
                                       "public",
                                       "register",
                                       "reinterpret_cast",
                                       "requires",
                                       "return",
                                       "short",
                                       "signed",
                                       "sizeof",
                                       "static",
                                       "static_assert",
                                       "static_cast",
                                       "stderr",
                                       "stdin",
                                       "stdout",
                                       "struct",
                                       "switch",
                                       "template",
                                       "this",
                                       "thread_local",
                                       "throw",
                                       "true",
                                       "try",
                                       "typedef",
                                       "typeid",
                                       "typename",
                                       "union",
                                       "unix",
                                       "unsigned",
                                       "using",
                                       "virtual",
                                       "void",
                                       "volatile",
                                       "wchar_t",
                                       "while",
                                       "xor",
                                       "xor_eq"};

/// Members of the classes from which generated ones are derived, and their own.
constexpr std::string_view kMembers[] = {
    "Placeholder", "Service", "command", "execute", "interface", "name",     "on_failed",
    "peer",        "publish", "raise",   "refuse",  "request",   "subscribe"};

/// What generated functions call their own parameters and variables, and what they call.
constexpr std::string_view kVariables[] = {"command", "in_range",   "operation",
                                           "options", "parameters", "priority",
                                           "refuse",  "reply",      "request"};

/// Functions and namespaces that generated code calls.
constexpr std::string_view kTypes[] = {"armature",     "decode",   "encode",
                                       "event_number", "in_range", "std"};

template <std::size_t N>
bool is_one_of(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

bool is_cpp_name(std::string_view name) {
  const bool begins = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0;
  return begins && !is_one_of(kWords, name) && std::all_of(name.begin(), name.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
         });
}

std::vector<std::string> divided(std::string_view name_space) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = name_space.find("::");
    parts.emplace_back(name_space.substr(0, end));
    if (end == std::string_view::npos) return parts;
    name_space.remove_prefix(end + 2);
  }
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
    const std::vector<std::string> parts = divided(name_space);
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
    for (const Structure& each : module.structures) {
      refuse_reserved(each.name, each.where);
      scope.add(names_.type(each.name), "'" + each.name + "'", each.where);
    }
    for (const Interface& each : module.interfaces) {
      refuse_reserved(each.name, each.where);
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
      refuse_reserved(member.name, member.where);
      scope.add(names_.member(member.name), "member '" + member.name + "'", member.where);
    }
  }

  void check_operations(const Interface& interface) {
    Scope scope("the classes of interface '" + interface.name + "'", diagnostics_);
    for (const EventName& event : interface.events) {
      scope.add("on_" + event.name, "the handler of event '" + event.name + "'", event.where);
    }
    for (const Operation& operation : interface.operations) {
      refuse_reserved(operation.name, operation.where);
      scope.add(names_.operation(operation.name), "operation '" + operation.name + "'",
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
      refuse_reserved(parameter.name, parameter.where);
      scope.add(cpp_names[i], "parameter '" + parameter.name + "'", parameter.where);
    }
  }

  void refuse_reserved(const std::string& name, const base::Location& where) {
    if (name.find("__") == std::string::npos && !name.starts_with('_')) return;
    diagnostics_.error(where,
                       "'" + name +
                           "' cannot be a name: C++ keeps those that begin with "
                           "'_' or have '__' in them for itself",
                       "rename it");
  }

  const Program& program_;
  const CppNames& names_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

CppNames::CppNames(const Program& program, std::string name_space)
    : name_space_(std::move(name_space)) {
  for (const Module& module : program.modules()) {
    name_spaces_.insert(divided(this->name_space(module)).front());
  }
  for (const Module& module : program.modules()) {
    for (const Structure& each : module.structures) types_.insert(type(each.name));
    for (const Interface& each : module.interfaces) {
      types_.insert({placeholder(each), service(each), constant(each)});
      types_.insert(constant(each) + "Declarations");
    }
  }
}

std::string CppNames::name_space(const std::string& module) const {
  return name_space_.empty() ? module : name_space_;
}

std::string CppNames::type(const std::string& name) const {
  const bool taken =
      is_one_of(kWords, name) || is_one_of(kTypes, name) || name_spaces_.contains(name);
  return taken ? name + "_" : name;
}

std::string CppNames::member(const std::string& name) const {
  std::string result = is_one_of(kWords, name) ? name + "_" : name;
  while (types_.contains(result)) result += "_";
  return result;
}

std::string CppNames::operation(const std::string& name) const {
  return member(is_one_of(kMembers, name) ? name + "_" : name);
}

std::vector<std::string> CppNames::parameters(const std::vector<Field>& parameters) const {
  std::set<std::string> taken;
  for (const Field& parameter : parameters) taken.insert(parameter.name);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    std::string name = parameters[i].name;
    if (name.empty()) {
      name = i < 26 ? std::string(1, static_cast<char>('a' + i)) : "p" + std::to_string(i + 1);
      while (taken.contains(name)) name += "_";
      taken.insert(name);
    }
    names.push_back(member(is_one_of(kVariables, name) ? name + "_" : name));
  }
  return names;
}

void check_cpp_names(const Program& program, const CppNames& names,
                     base::Diagnostics& diagnostics) {
  NameChecker(program, names, diagnostics).run();
}

}  // namespace armature::idl
