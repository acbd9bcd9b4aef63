// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/deploy/internal/expand.hpp"
#include "armature/deploy/internal/overrides.hpp"
#include "armature/deploy/load.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"

namespace armature::deploy {

using namespace document;
namespace internal {
namespace {

const base::Location kCommandLine{std::string(kCommandLineName), 0, 0};

/// The component whose name is the longest beginning of `path`, and the rest after its dot.
struct Target {
  Component* component;
  std::string rest;
};

Target find_target(Document& document, const std::string& path) {
  Target best{nullptr, {}};
  std::size_t longest = 0;
  for (Component& component : document.components) {
    const std::size_t size = component.name.size();
    const bool begins =
        path.size() > size + 1 && path[size] == '.' && path.compare(0, size, component.name) == 0;
    if (!begins || size < longest) continue;
    longest = size;
    best = {&component, path.substr(size + 1)};
  }
  return best;
}

void refuse_target(const Document& document, const std::string& path,
                   base::Diagnostics& diagnostics) {
  const std::string name = path.substr(0, path.find('.'));
  std::vector<std::string> known;
  for (const Composite& composite : document.composites) {
    if (composite.name != name) continue;
    for (const Property& parameter : composite.parameters) known.push_back(parameter.name);
    for (const Export& one : composite.exports) {
      if (one.kind == ExportKind::kProperty) known.push_back(one.name);
    }
    const std::string rest = path.substr(path.find('.') + 1);
    diagnostics.error(kCommandLine, "composite '" + name + "' has no parameter " + in_quotes(rest),
                      base::suggestion(rest, known));
    return;
  }
  for (const Component& component : document.components) known.push_back(component.name);
  diagnostics.error(kCommandLine, "unknown component " + in_quotes(name) + " in " + in_quotes(path),
                    base::suggestion(name, known));
}

/// A component with a property, or a composite with a parameter, of that name; empty if the
/// document gives none a value.
std::string owner_of(const Document& document, std::string_view property) {
  for (const Component& component : document.components) {
    if (find(component.properties, property) != nullptr) return component.name;
  }
  for (const Composite& composite : document.composites) {
    if (find(composite.parameters, property) != nullptr) return composite.name;
  }
  return {};
}

/// `value` as the only entry of maps inside each other: `a.b` makes {a: {b: value}}.
Value nested(std::string_view path, Value value) {
  const std::size_t dot = path.find('.');
  Value map = make_map(value.where);
  const base::Location where = value.where;
  Value inner = dot == std::string_view::npos ? std::move(value)
                                              : nested(path.substr(dot + 1), std::move(value));
  map.entries.push_back({std::string(path.substr(0, dot)), std::move(inner), {}, where});
  return map;
}

/// Puts `value` where the dotted path leads, into maps that are there or made on the way.
void set_in(std::vector<Property>& properties, std::string_view path, Value value) {
  const std::size_t dot = path.find('.');
  const std::string_view name = path.substr(0, dot);
  Property* property = find(properties, name);
  if (property == nullptr) {
    properties.push_back({std::string(name), {}, {}, value.where});
    property = &properties.back();
  }
  if (dot == std::string_view::npos) {
    property->value = std::move(value);
    return;
  }
  if (property->value.kind != Value::Kind::kMap) property->value = make_map(value.where);
  set_in(property->value.entries, path.substr(dot + 1), std::move(value));
}

void set_property(Component& component, const std::string& path, const Value& value,
                  const ValueReader& reader) {
  if (find(component.properties, path) == nullptr && !is_dotted_name(path)) {
    reader.error(value.where, "property " + in_quotes(path) + " is not a valid name");
    return;
  }
  if (Property* whole = find(component.properties, path)) {
    whole->value = value;
  } else {
    set_in(component.properties, path, value);
  }
}

/// One for each number of the range that `path` may have.
void add_each(const std::string& path, const Value& value, std::vector<Override>& overrides,
              base::Diagnostics& diagnostics) {
  const std::optional<RangeInText> range = find_range(path, kCommandLine, diagnostics);
  if (!range) {
    if (!has_range(path)) overrides.push_back({path, value});
    return;
  }
  const std::string before = path.substr(0, range->begin);
  const std::string after = path.substr(range->end);
  if (has_range(after)) {
    diagnostics.error(kCommandLine, in_quotes(path) + " has more than one range",
                      "write numbers in place of all but one");
    return;
  }
  for (int number = range->range.first; number <= range->range.last; ++number) {
    overrides.push_back({before + std::to_string(number) + after, value});
  }
}

}  // namespace

std::vector<Override> parse_overrides(const std::vector<std::string>& settings,
                                      base::Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == 0 || equals == std::string::npos) {
      diagnostics.error(kCommandLine, in_quotes(setting) + " must have the form name=value",
                        "for example Joint1.GearRatio=0.02");
      continue;
    }
    Value value = parse_yaml_value(std::string_view(setting).substr(equals + 1), kCommandLine,
                                   Limits{}, diagnostics);
    value.where = kCommandLine;
    if (value.kind == Value::Kind::kNone) value = make_text("", kCommandLine);
    value.literal = true;
    add_each(setting.substr(0, equals), value, overrides, diagnostics);
  }
  return overrides;
}

std::vector<Property> take_overrides(std::vector<Override>& overrides, std::string_view prefix,
                                     const std::vector<std::string>& names) {
  std::vector<Property> taken;
  for (Override& one : overrides) {
    const std::string_view path = one.path;
    if (path.substr(0, prefix.size()) != prefix) continue;
    const std::string_view name = path.substr(prefix.size());
    if (std::find(names.begin(), names.end(), name) == names.end()) continue;
    one.used = true;
    std::erase_if(taken, [&](const Property& earlier) { return earlier.name == name; });
    taken.push_back({std::string(name), one.value, {}, one.value.where});
  }
  return taken;
}

void refuse_parameter(const Document& document, const Override& setting,
                      const std::vector<std::string>& known, base::Diagnostics& diagnostics) {
  const std::string form = "properties are set as Component.Property=value";
  base::Hint hint = base::suggestion(setting.path, known);
  if (const std::string owner = owner_of(document, setting.path); !owner.empty()) {
    hint = form + ", here " + owner + "." + setting.path + "=" + to_text(setting.value);
  } else if (base::near_name(setting.path, known).empty()) {
    hint.text += (hint.empty() ? "" : "; ") + form;
  }
  diagnostics.error(setting.value.where, "the document has no parameter " + in_quotes(setting.path),
                    std::move(hint));
}

void apply_override(Document& document, const Override& setting, base::Diagnostics& diagnostics) {
  const auto [component, rest] = find_target(document, setting.path);
  if (component == nullptr) return refuse_target(document, setting.path, diagnostics);
  const ValueReader reader("component '" + component->name + "'", diagnostics);
  constexpr std::string_view kActivity = "activity";
  if (rest == kActivity) {
    read_activity(setting.value, reader, document.priorities, component->activity);
  } else if (rest.rfind(std::string(kActivity) + ".", 0) == 0) {
    const Value change = nested(rest.substr(kActivity.size() + 1), setting.value);
    read_activity(change, reader, document.priorities, component->activity);
  } else {
    set_property(*component, rest, setting.value, reader);
  }
}

}  // namespace internal

void apply_override(Document& document, std::string_view setting, base::Diagnostics& diagnostics) {
  for (const internal::Override& one :
       internal::parse_overrides({std::string(setting)}, diagnostics)) {
    internal::apply_override(document, one, diagnostics);
  }
}

}  // namespace armature::deploy
