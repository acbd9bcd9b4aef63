// SPDX-License-Identifier: Apache-2.0
#include "idl/typescript_names.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "idl/internal/words.hpp"

namespace armature::idl {
namespace {

/// What cannot be the name of a variable or class in a module.
constexpr std::string_view kLanguageWords[] = {
    "arguments", "await",      "break",   "case",    "catch",      "class",     "const",
    "continue",  "debugger",   "default", "delete",  "do",         "else",      "enum",
    "eval",      "export",     "extends", "false",   "finally",    "for",       "function",
    "if",        "implements", "import",  "in",      "instanceof", "interface", "let",
    "new",       "null",       "package", "private", "protected",  "public",    "return",
    "static",    "super",      "switch",  "this",    "throw",      "true",      "try",
    "typeof",    "undefined",  "var",     "void",    "while",      "with",      "yield"};

/// What cannot be the name of a type, or what generated code means by it, as its own parameters.
constexpr std::string_view kTypeWords[] = {"Promise", "Uint8Array", "any",     "as",       "bigint",
                                           "boolean", "handler",    "infer",   "keyof",    "never",
                                           "number",  "object",     "options", "readonly", "ride",
                                           "string",  "symbol",     "unique",  "unknown"};

/// Members of the class from which placeholders are derived, and what every object has: a class
/// with a function `then` would be waited for.
constexpr std::string_view kMemberWords[] = {
    "command", "component", "constructor", "hasOwnProperty", "name", "named",    "on_failed",
    "peer",    "prototype", "request",     "subscribe",      "then", "toString", "valueOf"};

using Taken = std::function<bool(const std::string&)>;

std::string free_name(std::string name, const Taken& is_taken) {
  while (is_taken(name)) name = changed(name);
  return name;
}

/// The name itself if nobody has it, otherwise one that nothing has.
/// @param siblings  as the language names them
std::string among(const std::string& name, const std::set<std::string>& siblings,
                  const Taken& is_taken) {
  if (!is_taken(name)) return name;
  return free_name(changed(name), [&](const std::string& other) {
    return is_taken(other) || siblings.contains(other);
  });
}

bool is_no_member(const std::string& name) { return name == "__proto__"; }

}  // namespace

TypescriptNames::TypescriptNames(const Program& program) {
  for (const Module& module : program.modules()) {
    for (const Enumeration& each : module.enumerations) declared_.insert(each.name);
    for (const Structure& each : module.structures) declared_.insert(each.name);
    for (const Interface& each : module.interfaces) declared_.insert(placeholder(each));
  }
  std::set<std::string> services;
  for (const Interface& each : program.main().interfaces) services.insert(service(each));
  for (const Module& module : program.modules()) {
    std::string name = module.name;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; }, '_');
    if (std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "_" + name;
    modules_[module.name] = free_name(name, [&](const std::string& other) {
      return is_one_of(kLanguageWords, other) || is_one_of(kTypeWords, other) ||
             declared_.contains(other) || services.contains(other) ||
             std::ranges::any_of(modules_, [&](const auto& one) { return one.second == other; });
    });
  }
}

std::string TypescriptNames::module(const std::string& name) const { return modules_.at(name); }

std::string TypescriptNames::type(const std::string& name) const {
  return among(name, declared_, [](const std::string& other) {
    return is_one_of(kLanguageWords, other) || is_one_of(kTypeWords, other);
  });
}

std::string TypescriptNames::placeholder(const Interface& interface) const {
  return interface.name + "Placeholder";
}

std::string TypescriptNames::service(const Interface& interface) const {
  return interface.name + "Service";
}

std::string TypescriptNames::raiser(const Interface& interface, const std::string& event) const {
  return free_name("raise_" + event, [&](const std::string& other) {
    return std::ranges::any_of(interface.operations, [&](const Operation& each) {
      return operation(interface, each.name) == other;
    });
  });
}

std::string TypescriptNames::call(const std::vector<std::string>& parameters) const {
  return free_name("call", [&](const std::string& other) {
    return std::ranges::find(parameters, other) != parameters.end();
  });
}

std::string TypescriptNames::member(const Structure& structure, const std::string& name) const {
  std::set<std::string> siblings;
  for (const Field& each : structure.members) siblings.insert(each.name);
  return among(name, siblings, is_no_member);
}

std::string TypescriptNames::operation(const Interface& interface, const std::string& name) const {
  std::set<std::string> siblings;
  for (const Operation& each : interface.operations) siblings.insert(each.name);
  std::set<std::string> handlers;
  for (const EventName& each : interface.events) handlers.insert(handler(each.name));
  return among(name, siblings, [&](const std::string& other) {
    return is_one_of(kMemberWords, other) || is_no_member(other) || handlers.contains(other);
  });
}

std::string TypescriptNames::handler(const std::string& event) const {
  return among("on_" + event, {},
               [](const std::string& other) { return is_one_of(kMemberWords, other); });
}

std::vector<std::string> TypescriptNames::parameters(const std::vector<Field>& parameters) const {
  std::set<std::string> siblings;
  for (const Field& each : parameters) siblings.insert(each.name);
  const Taken hides = [&](const std::string& other) {
    const bool module =
        std::ranges::any_of(modules_, [&](const auto& one) { return one.second == other; });
    return other == "options" || is_one_of(kLanguageWords, other) || is_one_of(kTypeWords, other) ||
           module || std::ranges::any_of(declared_, [&](const std::string& one) {
             return type(one) == other;
           });
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].name.empty()) {
      names.push_back(among(parameters[i].name, siblings, hides));
      continue;
    }
    const auto by_place =
        i < 26 ? std::string(1, static_cast<char>('a' + i)) : "p" + std::to_string(i + 1);
    names.push_back(free_name(by_place, [&](const std::string& other) {
      return hides(other) || siblings.contains(other);
    }));
  }
  return names;
}

}  // namespace armature::idl
