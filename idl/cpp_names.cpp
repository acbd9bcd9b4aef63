// SPDX-License-Identifier: Apache-2.0
#include "idl/cpp_names.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "idl/cpp_words.hpp"
#include "idl/internal/words.hpp"

namespace armature::idl {
namespace {

/// Members of the classes from which generated ones are derived, and their own: what an operation
/// with their name would keep generated code from finding.
constexpr std::string_view kMembers[] = {
    "Placeholder", "Service", "command", "execute", "in_range", "interface", "name",
    "on_failed",   "peer",    "publish", "raise",   "refuse",   "request",   "subscribe"};

/// All other members of those classes: what hides a type of their name in them.
constexpr std::string_view kHiding[] = {"Then",
                                        "ask",
                                        "call",
                                        "component_",
                                        "error_text",
                                        "found",
                                        "friend_",
                                        "has_subscribers",
                                        "interface_",
                                        "peer_",
                                        "publisher_",
                                        "send",
                                        "subscription_changes"};

/// What generated functions call their own parameters and variables, and what they call; types and
/// data of the classes that they belong to.
constexpr std::string_view kVariables[] = {"Placeholder", "Service",    "Then",       "command",
                                           "component_",  "in_range",   "interface_", "operation",
                                           "options",     "parameters", "peer_",      "priority",
                                           "publisher_",  "refuse",     "reply",      "request"};

/// Parameters and variables beside which a generated function names a type.
constexpr std::string_view kBesideTypes[] = {"event", "from", "handler", "to", "type", "value"};

/// Functions and namespaces that generated code uses.
constexpr std::string_view kTypes[] = {"armature",     "armature_describe", "decode", "encode",
                                       "event_number", "in_range",          "std"};

bool is_taken_for_types(std::string_view name) {
  return is_cpp_word(name) || is_one_of(kTypes, name) || is_one_of(kMembers, name) ||
         is_one_of(kHiding, name) || is_one_of(kVariables, name) || is_one_of(kBesideTypes, name);
}

/// Without what C++ keeps for itself: `__` anywhere, and `_` before a capital letter in front.
std::string allowed(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (c != '_' || !text.ends_with('_')) text += c;
  }
  const bool reserved =
      text.size() > 1 && text[0] == '_' && std::isupper(static_cast<unsigned char>(text[1])) != 0;
  if (!reserved) return text;
  text.erase(0, 1);
  return text.ends_with('_') ? text : text + "_";
}

std::string joined(const std::string& front, const std::string& back) {
  return allowed(front + back);
}

}  // namespace

std::vector<std::string> parts_of_name_space(std::string_view name_space) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t end = name_space.find("::");
    parts.emplace_back(name_space.substr(0, end));
    if (end == std::string_view::npos) return parts;
    name_space.remove_prefix(end + 2);
  }
}

CppNames::CppNames(const Program& program, std::optional<std::string> name_space)
    : name_space_(std::move(name_space)) {
  for (const Module& module : program.modules()) {
    name_spaces_.insert(parts_of_name_space(this->name_space(module)).front());
  }
  for (const Module& module : program.modules()) {
    for (const Enumeration& each : module.enumerations) types_.insert(type(each.name));
    for (const Structure& each : module.structures) types_.insert(type(each.name));
    for (const Interface& each : module.interfaces) {
      types_.insert({placeholder(each), service(each), constant(each)});
      types_.insert(constant(each) + "Declarations");
    }
  }
}

std::string CppNames::name_space(const std::string& module) const {
  if (name_space_) return *name_space_;
  const bool taken = module == "Placeholder" || module == "Service" || module == "Then" ||
                     module == "armature" || module == "main" || module == "std" ||
                     is_cpp_word(module) || is_global_in_cpp(module);
  return taken ? changed(module) : allowed(module);
}

std::string CppNames::type(const std::string& name) const {
  std::string result = allowed(name);
  while (is_taken_for_types(result) || name_spaces_.contains(result)) result = changed(result);
  return result;
}

std::string CppNames::placeholder(const Interface& interface) const {
  return joined(interface.name, "Placeholder");
}

std::string CppNames::service(const Interface& interface) const {
  return joined(interface.name, "Service");
}

std::string CppNames::constant(const Interface& interface) const {
  return joined("k", interface.name);
}

std::string CppNames::enumerator(const std::string& name) const {
  std::string result = "k";
  bool begins_word = true;
  for (const char c : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (begins_word && !letter && result != "k") result += '_';
    if (c != '_') result += begins_word ? static_cast<char>(std::toupper(c)) : c;
    begins_word = c == '_';
  }
  return result;
}

std::string CppNames::member(const std::string& name) const {
  std::string result = allowed(name);
  if (is_cpp_word(result)) result = changed(result);
  while (types_.contains(result)) result = changed(result);
  return result;
}

std::string CppNames::operation(const Interface& interface, const std::string& name) const {
  const auto is_handler = [&](const std::string& result) {
    return std::ranges::any_of(
        interface.events, [&](const EventName& event) { return handler(event.name) == result; });
  };
  std::string result = allowed(name);
  if (is_one_of(kMembers, result)) result = changed(result);
  while (is_handler(result)) result = changed(result);
  return member(result);
}

std::string CppNames::handler(const std::string& event) const {
  const std::string name = joined("on_", event);
  return member(is_one_of(kMembers, name) ? changed(name) : name);
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
    name = allowed(name);
    names.push_back(member(is_one_of(kVariables, name) ? changed(name) : name));
  }
  return names;
}

}  // namespace armature::idl
