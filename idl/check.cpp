// SPDX-License-Identifier: Apache-2.0
#include "idl/check.hpp"

#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "armature/base/near_name.hpp"
#include "idl/canonical.hpp"
#include "idl/internal/in_quotes.hpp"
#include "idl/internal/structure_sizes.hpp"
#include "idl/limits.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace {

using internal::Size;
using internal::StructureSizes;

std::string place(const base::Location& where) {
  return where.file + ":" + std::to_string(where.line) + ":" + std::to_string(where.column);
}

std::string kind_of(const Structure& structure) { return structure.is_event ? "event" : "struct"; }

/// `catch_up` for `catchUp`, `CatchUp`, `CATCH_UP` and `catch__up_`; `mode_2` and `catch_up` stay.
std::string in_small_letters(const std::string& name) {
  std::string text;
  bool after_small = false;
  for (const char c : name) {
    const bool capital = c >= 'A' && c <= 'Z';
    const bool begins_word = c == '_' || (capital && after_small);
    if (begins_word && !text.empty() && !text.ends_with('_')) text += '_';
    if (c != '_') text += capital ? static_cast<char>(c - 'A' + 'a') : c;
    after_small = !capital && c != '_';
  }
  if (text.ends_with('_')) text.pop_back();
  return text;
}

/// Names of one kind, of which each may be there once.
class Names {
 public:
  explicit Names(base::Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void add(const std::string& name, const std::string& what, const base::Location& where) {
    const auto [first, is_new] = first_.emplace(name, where);
    if (is_new) return;
    diagnostics_.error(where, what + " " + in_quotes(name) + " is defined twice; the first is at " +
                                  place(first->second));
  }

 private:
  base::Diagnostics& diagnostics_;
  std::map<std::string, base::Location> first_;
};

class Checker {
 public:
  Checker(const Program& program, base::Diagnostics& diagnostics)
      : program_(program), diagnostics_(diagnostics), sizes_(program, diagnostics) {}

  void run() {
    check_names();
    for (const Module& module : program_.modules()) {
      if (diagnostics_.error_count() >= kMostErrors) return;
      see(module);
      for (const Enumeration& each : module.enumerations) check_enumeration(each);
      for (const Structure& structure : module.structures) check_structure(structure);
      for (const Interface& interface : module.interfaces) check_interface(interface);
    }
  }

 private:
  void check_names() {
    Names names(diagnostics_);
    for (const Module& module : program_.modules()) {
      for (const Enumeration& each : module.enumerations) names.add(each.name, "enum", each.where);
      for (const Structure& each : module.structures)
        names.add(each.name, kind_of(each), each.where);
      for (const Interface& each : module.interfaces) names.add(each.name, "interface", each.where);
    }
  }

  /// What a module may use: its own, and all that it imports.
  void see(const Module& module) {
    std::set<std::string>& visible = visible_[module.name];
    visible.insert(module.name);
    complete_ = complete_ && module.complete;
    for (const Import& import : module.imports) {
      const std::set<std::string> theirs = visible_[import.module];
      visible.insert(theirs.begin(), theirs.end());
    }
    current_ = &visible;
    names_.clear();
    for (const Module& each : program_.modules()) {
      if (visible.count(each.name) == 0) continue;
      for (const Structure& one : each.structures) names_[kind_of(one)].push_back(one.name);
      for (const Enumeration& one : each.enumerations) names_["enum"].push_back(one.name);
    }
  }

  void check_enumeration(const Enumeration& enumeration) {
    const std::string whole = "enum " + in_quotes(enumeration.name);
    refuse_more_than(kMostEnumerators, enumeration.enumerators.size(), whole, "enumerators",
                     enumeration.where);
    Names names(diagnostics_);
    std::map<Whole, std::string> first;
    for (const Enumerator& each : enumeration.enumerators) {
      names.add(each.name, "enumerator", each.where);
      check_enumerator(each, enumeration);
      const auto [same, is_new] = first.emplace(each.value, each.name);
      if (is_new) continue;
      diagnostics_.error(each.where, "enumerators " + in_quotes(same->second) + " and " +
                                         in_quotes(each.name) + " of " + whole + " are both " +
                                         to_text(each.value));
    }
    if (first.contains(Whole{})) return;
    diagnostics_.error(
        enumeration.where,
        whole + " has no enumerator with the value 0, which every value has before it is set");
  }

  void check_enumerator(const Enumerator& enumerator, const Enumeration& enumeration) {
    const std::string plain = in_small_letters(enumerator.name);
    if (plain != enumerator.name) {
      const bool is_name =
          !plain.empty() && std::isalpha(static_cast<unsigned char>(plain[0])) != 0;
      diagnostics_.error(enumerator.where,
                         "expected the name of an enumerator in small letters and digits, with '_' "
                         "between words, found " +
                             in_quotes(enumerator.name),
                         is_name ? "write " + in_quotes(plain) : "");
    }
    const WholeLimits limits = limits_of(enumeration.underlying);
    const bool holds = !(enumerator.value < limits.least) && !(limits.greatest < enumerator.value);
    if (holds) return;
    const bool is_largest = enumeration.underlying == Basic::kLong;
    diagnostics_.error(
        enumerator.where,
        "enumerator " + in_quotes(enumerator.name) + " is " + to_text(enumerator.value) +
            "; expected a number that " + in_quotes(name_of(enumeration.underlying)) + " holds, " +
            to_text(limits.least) + " to " + to_text(limits.greatest),
        is_largest ? "" : "give it a larger type: 'enum " + enumeration.name + " : long'");
  }

  void check_structure(const Structure& structure) {
    const std::string whole = kind_of(structure) + " " + in_quotes(structure.name);
    if (structure.members.empty() && structure.complete) {
      diagnostics_.error(structure.where, whole + " has no member; expected at least one");
    }
    refuse_more_than(kMostMembers, structure.members.size(), whole, "members", structure.where);
    Names names(diagnostics_);
    for (const Field& member : structure.members) {
      names.add(member.name, "member", member.where);
      check_field(member, "member " + in_quotes(member.name));
    }
    const Size size = sizes_.of(structure);
    if (size.wire > kLargestBody) {
      diagnostics_.error(structure.where, whole + " has more than " + std::to_string(kLargestBody) +
                                              " bytes, the most that a message holds");
    }
  }

  void check_interface(const Interface& interface) {
    const std::string whole = "interface " + in_quotes(interface.name);
    const std::size_t count = interface.operations.size() + interface.events.size();
    if (count == 0 && interface.complete && complete_) {
      diagnostics_.error(interface.where,
                         whole + " has no operation and raises no event; expected at least one");
    }
    refuse_more_than(kMostDeclarations, count, whole, "operations and events", interface.where);
    Names operations(diagnostics_);
    for (const Operation& operation : interface.operations) {
      operations.add(operation.name, "operation", operation.where);
      check_operation(operation);
    }
    Names events(diagnostics_);
    for (const EventName& event : interface.events) {
      events.add(event.name, "event", event.where);
      check_known(event.name, "event", event.where);
    }
    // Canonical forms exist only of what is right so far.
    if (diagnostics_.ok()) check_numbers(interface);
  }

  void check_operation(const Operation& operation) {
    const std::string whole = "operation " + in_quotes(operation.name);
    refuse_more_than(kMostParameters, operation.parameters.size(), whole, "parameters",
                     operation.where);
    check_type(operation.result);
    Names names(diagnostics_);
    for (const Field& parameter : operation.parameters) {
      const bool named = !parameter.name.empty();
      if (named) names.add(parameter.name, "parameter", parameter.where);
      check_field(parameter, named ? "parameter " + in_quotes(parameter.name) : "the parameter");
    }
    const Size size = sizes_.of(operation.parameters);
    const Size result = sizes_.of(operation.result);
    if (size.wire > kLargestBody || result.wire > kLargestBody) {
      diagnostics_.error(operation.where, whole + " has more than " + std::to_string(kLargestBody) +
                                              " bytes, the most that a message holds");
    }
    if (size.canonical + result.canonical + operation.name.size() > kLongestCanonical) {
      diagnostics_.error(operation.where, whole + ", with its structs written out, has more than " +
                                              std::to_string(kLongestCanonical) + " characters");
    }
  }

  void check_numbers(const Interface& interface) {
    // Every component raises it when a command fails.
    constexpr std::string_view kBuiltIn = "event Failed{String,String}";
    std::map<std::uint32_t, std::string> first{{number_of(kBuiltIn), std::string(kBuiltIn)}};
    const auto add = [&](const std::string& declaration, const base::Location& where) {
      const auto [found, is_new] = first.emplace(number_of(declaration), declaration);
      if (is_new) return;
      if (declaration == kBuiltIn) {
        diagnostics_.error(where, "every interface has '" + declaration + "' already",
                           "leave it out, or choose another name");
        return;
      }
      diagnostics_.error(
          where, "'" + declaration + "' has the same number on the wire as '" + found->second + "'",
          "rename one of them");
    };
    for (const Operation& operation : interface.operations) {
      add(canonical(program_, operation), operation.where);
    }
    for (const EventName& event : interface.events) {
      add(canonical(program_, *program_.find_event(event.name)), event.where);
    }
  }

  void check_field(const Field& field, const std::string& what) {
    check_type(field.type);
    if (!is_number(field.type.basic) && !field.unit.empty()) {
      diagnostics_.error(field.where, what + " has a unit but is not a number; its type is " +
                                          in_quotes(to_text(field.type)));
    }
    if (field.range) check_range(*field.range, field.type, what);
  }

  void check_type(const Type& type) {
    if (!type.name.empty()) check_known(type.name, std::string(name_of(type.basic)), type.where);
  }

  void check_known(const std::string& name, const std::string& kind, const base::Location& where) {
    const std::string* const module = module_of(name, kind);
    if (module != nullptr && current_->count(*module) > 0) return;
    // Behind a mistake in a definition its name is unknown, and there would be no end of it.
    if (!complete_) return;
    base::Hint hint = module != nullptr ? "import \"" + *module + ".idl\", which defines it"
                                        : base::suggestion(name, names_[kind]);
    for (const std::string other : {"struct", "event", "enum"}) {
      if (module != nullptr || module_of(name, other) == nullptr) continue;
      hint = in_quotes(name) + " is defined as " + other;
    }
    diagnostics_.error(where,
                       "unknown " + kind + " " + in_quotes(name) +
                           "; expected one that this file defines or imports",
                       std::move(hint));
  }

  /// Where a struct, event or enum is defined, or nullptr.
  const std::string* module_of(const std::string& name, const std::string& kind) const {
    if (kind == "enum") {
      const Enumeration* const found = program_.find_enum(name);
      return found == nullptr ? nullptr : &found->module;
    }
    const Structure* const found =
        kind == "event" ? program_.find_event(name) : program_.find_struct(name);
    return found == nullptr ? nullptr : &found->module;
  }

  void check_range(const Range& range, const Type& type, const std::string& what) {
    if (is_whole_number(type.basic)) return check_whole_range(range, type.basic, what);
    if (is_number(type.basic)) return check_real_range(range, type.basic, what);
    diagnostics_.error(range.where, what + " has a range but is not a number; its type is " +
                                        in_quotes(to_text(type)));
  }

  void check_whole_range(const Range& range, Basic type, const std::string& what) {
    const WholeLimits limits = limits_of(type);
    const auto low = parse_whole(range.low);
    const auto high = parse_whole(range.high);
    const auto holds = [&](const std::optional<Whole>& number) {
      return number && !(*number < limits.least) && !(limits.greatest < *number);
    };
    for (const auto& [text, number] : {std::pair(range.low, low), std::pair(range.high, high)}) {
      if (holds(number)) continue;
      diagnostics_.error(
          range.where, "the range of " + what + " has " + in_quotes(text) +
                           "; expected a whole number that " + in_quotes(name_of(type)) +
                           " holds, " + to_text(limits.least) + " to " + to_text(limits.greatest));
    }
    if (holds(low) && holds(high) && *high < *low) refuse_backwards(range, what);
  }

  void check_real_range(const Range& range, Basic type, const std::string& what) {
    // Up to half a step above the greatest float, decimal numbers mean that one.
    const double most = type == Basic::kFloat ? std::nextafter(0x1.ffffffp127, 0.0)
                                              : std::numeric_limits<double>::max();
    const auto low = parse_real(range.low);
    const auto high = parse_real(range.high);
    const auto holds = [&](const std::optional<double>& number) {
      return number && std::fabs(*number) <= most;
    };
    for (const auto& [text, number] : {std::pair(range.low, low), std::pair(range.high, high)}) {
      if (holds(number)) continue;
      diagnostics_.error(range.where, "the range of " + what + " has " + in_quotes(text) +
                                          "; expected a decimal number that " +
                                          in_quotes(name_of(type)) + " holds");
    }
    if (holds(low) && holds(high) && *high < *low) refuse_backwards(range, what);
  }

  void refuse_backwards(const Range& range, const std::string& what) {
    diagnostics_.error(
        range.where, "the range of " + what + " is empty: " + range.low + " is above " + range.high,
        "the least value comes first");
  }

  void refuse_more_than(std::size_t most, std::size_t count, const std::string& whole,
                        const std::string& parts, const base::Location& where) {
    if (count <= most) return;
    diagnostics_.error(where, whole + " has " + std::to_string(count) + " " + parts + "; at most " +
                                  std::to_string(most) + " are possible");
  }

  const Program& program_;
  base::Diagnostics& diagnostics_;
  StructureSizes sizes_;
  std::map<std::string, std::set<std::string>> visible_;  ///< modules, by the one that sees them
  const std::set<std::string>* current_ = nullptr;
  std::map<std::string, std::vector<std::string>> names_;  ///< visible now, by their kinds
  bool complete_ = true;                                   ///< no definition was lost to a mistake
};

}  // namespace

void check(const Program& program, base::Diagnostics& diagnostics) {
  Checker(program, diagnostics).run();
}

}  // namespace armature::idl
