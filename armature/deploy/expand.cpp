// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/expand.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/typed_text.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

constexpr std::size_t kLongestText = 1u << 20;
constexpr int kDeepestParameter = 100;
/// What `${here}` stands for everywhere: the folder of the file in which it is written.
constexpr std::string_view kHere = "here";

std::string folder_of(const base::Location& where) {
  const std::size_t slash = where.file.rfind('/');
  return slash == std::string::npos ? "." : where.file.substr(0, std::max<std::size_t>(slash, 1));
}

/// `${name}` in a text, from `begin` to `end`.
struct Use {
  std::size_t begin;
  std::size_t end;
  std::string_view name;
};

std::optional<Use> next_use(std::string_view text, std::size_t from) {
  const std::size_t begin = text.find("${", from);
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = text.find('}', begin);
  if (end == std::string_view::npos) return std::nullopt;
  return Use{begin, end + 1, text.substr(begin + 2, end - begin - 2)};
}

const Value* find_parameter(std::string_view name, const Scope& scope, const base::Location& where,
                            base::Diagnostics& diagnostics) {
  if (const Property* found = find(scope.parameters, name)) return &found->value;
  const base::Hint hint = scope.parameters.empty()
                              ? "declare it under parameters:"
                              : base::suggestion(name, names_of(scope.parameters));
  diagnostics.error(where, scope.owner + " has no parameter " + in_quotes(name), hint);
  return nullptr;
}

/// Names of the parameters that a tree uses.
void collect_uses(const Value& value, std::vector<std::string>& names) {
  if (value.literal) return;
  for (auto use = next_use(value.text, 0); use; use = next_use(value.text, use->end)) {
    names.emplace_back(use->name);
  }
  for (const Value& item : value.items) collect_uses(item, names);
  for (const Property& entry : value.entries) {
    for (auto use = next_use(entry.name, 0); use; use = next_use(entry.name, use->end)) {
      names.emplace_back(use->name);
    }
    collect_uses(entry.value, names);
  }
}

/// Resolves parameters in the order in which they need each other.
class ParameterResolver {
 public:
  ParameterResolver(Expander& expander, std::vector<Property> unresolved, std::string owner,
                    base::Diagnostics& diagnostics)
      : expander_(expander), unresolved_(std::move(unresolved)), diagnostics_(diagnostics) {
    states_.resize(unresolved_.size(), State::kWaiting);
    scope_.owner = std::move(owner);
  }

  std::vector<Property> resolve() {
    for (std::size_t i = 0; i < unresolved_.size(); ++i) resolve(i, 0);
    std::vector<Property> in_order;
    for (const Property& property : unresolved_) {
      if (const Property* done = find(scope_.parameters, property.name)) in_order.push_back(*done);
    }
    return in_order;
  }

 private:
  enum class State { kWaiting, kBusy, kDone };

  void resolve(std::size_t index, int depth) {
    if (states_[index] == State::kDone) return;
    const Property& property = unresolved_[index];
    const bool circular = states_[index] == State::kBusy;
    if (circular || depth > kDeepestParameter) {
      diagnostics_.error(
          property.where,
          "parameter " + in_quotes(property.name) +
              (circular ? " refers to itself" : " refers to others in too long a chain"),
          circular ? "give one parameter of the circle a value of its own"
                   : "give it a value with fewer references");
      scope_.parameters.push_back({property.name, make_text(""), {}, property.where});
      return;
    }
    states_[index] = State::kBusy;
    std::vector<std::string> needed;
    collect_uses(property.value, needed);
    for (const std::string& name : needed) {
      if (const Property* other = find(unresolved_, name)) {
        resolve(static_cast<std::size_t>(other - unresolved_.data()), depth + 1);
      }
    }
    finish(property);
    states_[index] = State::kDone;
  }

  void finish(const Property& property) {
    if (find(scope_.parameters, property.name) != nullptr) return;
    Property resolved = property;
    resolved.value = expander_.expand(property.value, scope_, diagnostics_);
    scope_.parameters.push_back(std::move(resolved));
  }

  Expander& expander_;
  std::vector<Property> unresolved_;
  base::Diagnostics& diagnostics_;
  std::vector<State> states_;
  Scope scope_;
};

}  // namespace

std::vector<std::string> names_of(const std::vector<Property>& properties) {
  std::vector<std::string> names;
  for (const Property& property : properties) names.push_back(property.name);
  return names;
}

bool Expander::spend(std::size_t nodes, const base::Location& where,
                     base::Diagnostics& diagnostics) {
  if (exhausted_) return false;
  if (nodes <= nodes_left_) {
    nodes_left_ -= nodes;
    return true;
  }
  exhausted_ = true;
  diagnostics.error(where, "ranges, parameters and composites expand to too many values",
                    "make the ranges smaller");
  return false;
}

bool Expander::spend_entries(std::size_t count, const std::string& what,
                             const base::Location& where, base::Diagnostics& diagnostics) {
  if (exhausted_) return false;
  if (count <= most_entries_ - entries_) {
    entries_ += count;
    return true;
  }
  exhausted_ = true;
  diagnostics.error(where,
                    what + " brings the deployment to more than " + std::to_string(most_entries_) +
                        " components and connections",
                    "nested composites multiply: make their ranges smaller");
  return false;
}

std::string Expander::replace_parameters(std::string_view text, const Scope& scope,
                                         const base::Location& where,
                                         base::Diagnostics& diagnostics) {
  std::string result;
  std::size_t copied = 0;
  for (auto use = next_use(text, 0); use; use = next_use(text, use->end)) {
    result += text.substr(copied, use->begin - copied);
    copied = use->end;
    if (use->name == kHere) {
      result += folder_of(where);
      continue;
    }
    const Value* value = find_parameter(use->name, scope, where, diagnostics);
    if (value == nullptr) {
      result += text.substr(use->begin, use->end - use->begin);
    } else if (value->kind == Value::Kind::kText) {
      result += value->text;
    } else {
      diagnostics.error(where, "parameter " + in_quotes(use->name) + " is " +
                                   std::string(name_of(value->kind)) +
                                   " and cannot be part of a text");
    }
    if (result.size() <= kLongestText) continue;
    diagnostics.error(where, "the text becomes longer than a million characters");
    return {};
  }
  result += text.substr(copied);
  return result;
}

base::Location Expander::origin_of(std::string_view text, const Scope& scope,
                                   const base::Location& where) {
  for (auto use = next_use(text, 0); use; use = next_use(text, use->end)) {
    if (const Property* parameter = find(scope.parameters, use->name)) {
      return parameter->value.where;
    }
  }
  return where;
}

std::string Expander::expand_text(const Value& text, const Scope& scope,
                                  base::Diagnostics& diagnostics) {
  if (text.literal) return text.text;
  std::string result = replace_parameters(text.text, scope, text.where, diagnostics);
  if (scope.number) result = replace_number(result, *scope.number, text.where, diagnostics);
  constexpr std::size_t kTextPerNode = 64;
  spend(result.size() / kTextPerNode, text.where, diagnostics);
  return result;
}

Value Expander::expand_whole_text(const Value& value, const Scope& scope,
                                  base::Diagnostics& diagnostics) {
  const std::optional<Use> use = value.literal ? std::nullopt : next_use(value.text, 0);
  const bool alone = use && use->begin == 0 && use->end == value.text.size() && use->name != kHere;
  const Property* parameter = alone ? find(scope.parameters, use->name) : nullptr;
  const bool unknown =
      alone && (parameter == nullptr || parameter->value.kind == Value::Kind::kNone);
  if (unknown) {
    if (parameter == nullptr) find_parameter(use->name, scope, value.where, diagnostics);
    Value none;
    none.literal = true;  // that there is no value was reported
    none.where = value.where;
    return none;
  }
  if (parameter != nullptr &&
      (parameter->value.literal || parameter->value.kind != Value::Kind::kText)) {
    if (!spend(count_nodes(parameter->value), value.where, diagnostics)) return {};
    return parameter->value;
  }
  Value copy = value;
  copy.text = expand_text(value, scope, diagnostics);
  const bool same_file = parameter != nullptr && parameter->value.where.file == value.where.file;
  if (same_file) copy.where = parameter->value.where;  // what is wrong with it is wrong there
  normalise_type(copy);
  return copy;
}

/// Keys with ranges or parameters may turn out to be the same.
void Expander::refuse_twins(const Value& map, base::Diagnostics& diagnostics) {
  std::unordered_map<std::string_view, const base::Location*> first;
  for (const Property& entry : map.entries) {
    const auto [earlier, is_new] = first.emplace(entry.name, &entry.where);
    if (is_new) continue;
    diagnostics.error(entry.where, in_quotes(entry.name) + " is given twice",
                      "first at " + place_text(*earlier->second));
  }
}

void Expander::expand_item(const Value& item, const Scope& scope, Value& list,
                           base::Diagnostics& diagnostics) {
  const bool may_repeat =
      item.kind == Value::Kind::kText && !item.literal && item.text.find("..") != std::string::npos;
  const std::string text =
      may_repeat ? replace_parameters(item.text, scope, item.where, diagnostics) : "";
  if (!has_range(text)) {
    list.items.push_back(expand(item, scope, diagnostics));
    return;
  }
  const std::optional<RangeInText> found = find_range(text, item.where, diagnostics);
  if (!found) return;
  for (int number = found->range.first; number <= found->range.last; ++number) {
    if (!spend(1, item.where, diagnostics)) return;
    Value copy = item;
    copy.text = text;
    copy.text.replace(found->begin, found->end - found->begin, std::to_string(number));
    copy.text = replace_number(copy.text, number, item.where, diagnostics);
    list.items.push_back(std::move(copy));
  }
}

void Expander::expand_entry(const Property& entry, const Scope& scope, Value& map,
                            base::Diagnostics& diagnostics) {
  if (entry.value.literal) {
    map.entries.push_back(entry);
    return;
  }
  const std::string name = replace_parameters(entry.name, scope, entry.where, diagnostics);
  const std::size_t errors = diagnostics.error_count();
  const std::optional<RangeInText> found = find_range(name, entry.where, diagnostics);
  if (diagnostics.error_count() != errors) return;
  const Range once{scope.number.value_or(0), scope.number.value_or(0)};
  const Range range = found ? found->range : once;
  Scope inner;
  if (found) inner = scope;
  for (int number = range.first; number <= range.last && !exhausted_; ++number) {
    Property copy{name, {}, entry.description, entry.where};
    if (found) {
      copy.name.replace(found->begin, found->end - found->begin, std::to_string(number));
      inner.number = number;
    }
    const Scope& here = found ? inner : scope;
    if (here.number) copy.name = replace_number(copy.name, *here.number, entry.where, diagnostics);
    copy.value = expand(entry.value, here, diagnostics);
    map.entries.push_back(std::move(copy));
  }
}

Value Expander::expand(const Value& value, const Scope& scope, base::Diagnostics& diagnostics) {
  if (!spend(1, value.where, diagnostics)) return {};
  if (value.kind == Value::Kind::kText) return expand_whole_text(value, scope, diagnostics);
  if (value.literal) {
    return spend(count_nodes(value), value.where, diagnostics) ? value : Value{};
  }
  Value copy;
  copy.kind = value.kind;
  copy.type = value.type;
  copy.where = value.where;
  for (const Value& item : value.items) expand_item(item, scope, copy, diagnostics);
  for (const Property& entry : value.entries) expand_entry(entry, scope, copy, diagnostics);
  const bool named_anew =
      std::any_of(value.entries.begin(), value.entries.end(),
                  [](const Property& entry) { return entry.name.find('{') != std::string::npos; });
  if (named_anew) refuse_twins(copy, diagnostics);
  normalise_type(copy);
  return copy;
}

std::vector<Property> Expander::resolve_parameters(const std::vector<Property>& declared,
                                                   const std::vector<Property>& given,
                                                   const std::string& owner,
                                                   base::Diagnostics& diagnostics) {
  std::vector<Property> all = declared;
  for (Property& parameter : all) {
    if (parameter.name == kHere) {
      diagnostics.error(parameter.where, owner + ": parameter 'here' is always the file's folder",
                        "choose another name");
    }
    if (const Property* other = find(given, parameter.name)) {
      parameter.value = other->value;
      parameter.value.literal = true;
    }
    if (parameter.value.kind == Value::Kind::kNone) {
      diagnostics.error(parameter.where,
                        owner + ": parameter " + in_quotes(parameter.name) + " has no value");
    }
  }
  return ParameterResolver(*this, std::move(all), owner, diagnostics).resolve();
}

}  // namespace armature::deploy::internal
