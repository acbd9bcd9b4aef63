// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/parameter_builder.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/interface.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/property_value.hpp"

namespace armature::deploy::internal {
namespace {

using component::Signature;
using From = component::CallParameter::From;

NameAndUnit parts_of(std::string_view text) {
  const std::size_t open = text.find(" [");
  if (open == std::string_view::npos || !text.ends_with(']')) return {std::string(text), {}};
  return {std::string(text.substr(0, open)),
          std::string(text.substr(open + 2, text.size() - open - 3))};
}

/// Arguments that nobody named are called by their number.
NameAndUnit argument(const Signature& signature, std::size_t index) {
  NameAndUnit named = parts_of(signature.arguments[index].name);
  if (named.name.empty()) named.name = "argument" + std::to_string(index + 1);
  return named;
}

/// `value [Unit]` has the unit that the property `Unit` of its component says.
std::string resolved(std::string unit, const component::Component* owner) {
  if (owner == nullptr) return unit;
  for (const component::PropertyBase* property : component::interface_of(*owner).properties) {
    const bool is_it = property->name() == unit;
    if (is_it && &property->type() == &types::type_of<std::string>()) {
      return *static_cast<const std::string*>(property->data());
    }
  }
  return unit;
}

std::vector<std::string> names_of(const Signature& signature) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < signature.arguments.size(); ++i) {
    names.push_back(argument(signature, i).name);
  }
  return names;
}

std::optional<std::size_t> find_argument(const Signature& signature, std::string_view name) {
  const std::vector<std::string> names = names_of(signature);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

bool same_unit(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto first = base::parse_unit(a);
  const auto second = base::parse_unit(b);
  return first && second && first.value().same_as(second.value());
}

std::string in_unit(const types::Type& type, std::string_view unit) {
  return type.name + (unit.empty() ? "" : " in " + in_quotes(unit));
}

template <typename List>
std::vector<std::string> member_names(const List& members) {
  std::vector<std::string> names;
  for (const auto* member : members) names.emplace_back(member->name());
  return names;
}

const component::OutputPortBase* output_of(const component::Component& component,
                                           std::string_view name) {
  for (const auto* port : component::interface_of(component).outputs) {
    if (port->name() == name) return port;
  }
  return nullptr;
}

/// Every parameter is given by name: in `with`, or as a member of the event.
bool are_named(const Called& called) {
  return std::ranges::all_of(names_of(called.signature), [&](const std::string& name) {
    return find(called.with, name) != nullptr || find_argument(*called.event, name).has_value();
  });
}

}  // namespace

std::optional<std::vector<component::CallParameter>> ParameterBuilder::parameters(
    const Called& called) {
  bool complete = check_names(called);
  std::vector<Parameter> made;
  for (std::size_t i = 0; i < called.signature.arguments.size(); ++i) {
    auto one = parameter(called, i);
    complete = complete && one;
    if (one) made.push_back(std::move(*one));
  }
  if (!complete) return std::nullopt;
  return made;
}

/// Every name in `with` is one of the command's parameters.
bool ParameterBuilder::check_names(const Called& called) {
  const std::vector<std::string> known = names_of(called.signature);
  bool good = true;
  for (const Property& written : called.with) {
    if (std::find(known.begin(), known.end(), written.name) != known.end()) continue;
    good = false;
    diagnostics_.error(written.where,
                       path(called.to) + " has no parameter " + in_quotes(written.name),
                       base::suggestion(written.name, known));
  }
  return good;
}

NameAndUnit ParameterBuilder::wanted_argument(const Called& called, std::size_t index) const {
  NameAndUnit wanted = argument(called.signature, index);
  wanted.unit = resolved(std::move(wanted.unit), find_component(components_, called.to.component));
  return wanted;
}

/// As `with` says; else the event's member of that name; where nothing is said and the names do not
/// fit, the one at the same place.
std::optional<component::CallParameter> ParameterBuilder::parameter(const Called& called,
                                                                    std::size_t index) {
  const NameAndUnit wanted = argument(called.signature, index);
  if (const types::Type& type = *called.signature.arguments[index].type; type.sealed) {
    diagnostics_.error(
        called.to.where,
        path(called.to) + " takes a " + type.name +
            ", which its own class gives a component that may have it: no " +
            (called.event != nullptr ? "event gives this command" : "deployment calls it"));
    return std::nullopt;
  }
  const Property* const written = find(called.with, wanted.name);
  if (written != nullptr) return given(called, index, *written);
  if (called.event != nullptr) return of_event(called, index);
  diagnostics_.error(
      called.where,
      "nothing gives the parameter " + in_quotes(wanted.name) + " of " + path(called.to),
      "say where it comes from: with: {" + wanted.name + ": a value or Component.Port}");
  return std::nullopt;
}

std::optional<component::CallParameter> ParameterBuilder::of_event(const Called& called,
                                                                   std::size_t index) {
  const std::string wanted = argument(called.signature, index).name;
  const bool one_by_one = called.with.empty() && !are_named(called) &&
                          called.event->arguments.size() == called.signature.arguments.size();
  if (one_by_one) return from_member(called, index, index, called.where);
  if (const auto named = find_argument(*called.event, wanted)) {
    return from_member(called, index, *named, called.where);
  }
  diagnostics_.error(called.where,
                     "nothing gives the parameter " + in_quotes(wanted) + " of " + path(called.to),
                     "say where it comes from: with: {" + wanted +
                         ": a value, Component.Port or a member of the event}");
  return std::nullopt;
}

std::optional<component::CallParameter> ParameterBuilder::given(const Called& called,
                                                                std::size_t index,
                                                                const Property& written) {
  const Value& value = written.value;
  if (value.kind == Value::Kind::kText && !value.literal) {
    const auto [component, port] = split_last_dot(value.text);
    if (find_component(components_, component) != nullptr) return from_port(called, index, value);
    const auto member =
        called.event == nullptr ? std::nullopt : find_argument(*called.event, value.text);
    if (member) return from_member(called, index, *member, value.where);
  }
  const NameAndUnit wanted = wanted_argument(called, index);
  const types::Type& type = *called.signature.arguments[index].type;
  const std::string subject = "parameter " + in_quotes(wanted.name) + " of " + path(called.to);
  auto constant = make_value(value, type, wanted.unit, subject, diagnostics_);
  if (!constant) return std::nullopt;
  Parameter made;
  made.from = From::kConstant;
  made.constant = std::make_shared<const types::Value>(std::move(*constant));
  return made;
}

std::optional<component::CallParameter> ParameterBuilder::from_member(const Called& called,
                                                                      std::size_t index,
                                                                      std::size_t member,
                                                                      const base::Location& where) {
  const Signature& event = *called.event;
  const NameAndUnit has = argument(event, member);
  const Offer offer{in_quotes(has.name) + " of " + path(*called.on), *event.arguments[member].type,
                    has.unit, where, "give it a value of that type and unit in with"};
  if (!fits(called, index, offer)) return std::nullopt;
  Parameter made;
  made.member = member;
  return made;
}

/// Its type and unit are those of the parameter, or it is a number that becomes one of them.
bool ParameterBuilder::fits(const Called& called, std::size_t index, const Offer& offer) {
  const NameAndUnit wants = wanted_argument(called, index);
  const types::Type& wanted = *called.signature.arguments[index].type;
  if (component::CallParameters::takes(wanted, offer.type) && same_unit(offer.unit, wants.unit))
    return true;
  diagnostics_.error(offer.where,
                     offer.what + " is " + in_unit(offer.type, offer.unit) + ", but " +
                         in_quotes(wants.name) + " of " + path(called.to) + " is " +
                         in_unit(wanted, wants.unit),
                     offer.hint);
  return false;
}

std::optional<component::CallParameter> ParameterBuilder::from_port(const Called& called,
                                                                    std::size_t index,
                                                                    const Value& written) {
  const auto [name, port_name] = split_last_dot(written.text);
  const component::Component& owner = *find_component(components_, name);
  const component::OutputPortBase* const port = output_of(owner, port_name);
  if (port == nullptr) {
    diagnostics_.error(
        written.where, in_quotes(name) + " has no output port " + in_quotes(port_name),
        base::suggestion(port_name, member_names(component::interface_of(owner).outputs)));
    return std::nullopt;
  }
  const Offer offer{in_quotes(written.text), port->type(), std::string(port->unit()), written.where,
                    "connect it to a component that converts it, and take that one's output"};
  if (!fits(called, index, offer)) return std::nullopt;
  Parameter made;
  made.from = From::kPort;
  made.input = called.prefix + argument(called.signature, index).name;
  made.port = port;
  return made;
}

void connect_parameters(const std::vector<component::CallParameter>& parameters,
                        const std::string& user, bool keeps_running, const base::Location& where,
                        exec::Blueprint& blueprint) {
  std::optional<component::OnLost> on_lost;
  if (keeps_running) on_lost = component::on_lost(component::Reaction::kHold);
  for (const component::CallParameter& parameter : parameters) {
    if (parameter.port == nullptr) continue;
    blueprint.connections.push_back({parameter.port->owner().name(),
                                     parameter.port->name(),
                                     user,
                                     parameter.input,
                                     {},
                                     {},
                                     on_lost,
                                     where});
  }
}

}  // namespace armature::deploy::internal
