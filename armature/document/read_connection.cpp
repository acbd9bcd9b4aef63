// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::document {
namespace {

constexpr int kLargestFifo = 1'000'000;
constexpr const char* kArrowHint = "for example Joint1.Position -> Sensor.Position1";

/// The trimmed part of a text, at its own column.
Value part_of(const Value& value, std::size_t begin, std::size_t end) {
  const std::string_view part = std::string_view(value.text).substr(begin, end - begin);
  Value result = value;
  result.text = trimmed(part);
  if (value.where.column > 0 && !result.text.empty()) {
    result.where.column += static_cast<int>(begin + part.find(result.text));
  }
  return result;
}

std::optional<Endpoint> read_endpoint(const Value& value, std::string_view what,
                                      const ValueReader& reader) {
  const std::optional<std::string> text = reader.text(value, what);
  if (!text) return std::nullopt;
  auto [component, port] = split_last_dot(trimmed(*text));
  if (is_dotted_name(component) && is_name(port)) {
    return Endpoint{std::move(component), std::move(port), value.where};
  }
  reader.error(value.where,
               std::string(what) + " must be component.port, found " + in_quotes(trimmed(*text)));
  return std::nullopt;
}

/// An event that commands may say it so: `{on: Button.Pressed, do: Lift.travel}`.
Value with_ends(Value map) {
  for (const auto& [own, end] : {std::pair("on", "from"), std::pair("do", "to")}) {
    Property* const entry = find(map.entries, own);
    if (entry != nullptr && find(map.entries, end) == nullptr) entry->name = end;
  }
  return map;
}

void read_fifo(const Value& value, const ValueReader& reader, ConnectionPolicy& policy) {
  Fields fields(value, reader);
  if (const Value* size = fields.take("fifo")) {
    policy.kind = ConnectionPolicy::Kind::kFifo;
    const auto capacity = reader.whole_number(*size, "fifo", 1, kLargestFifo);
    policy.capacity = static_cast<std::size_t>(capacity.value_or(1));
  } else {
    reader.error(value.where, "policy names no fifo", "for example {fifo: 8}");
  }
  if (const Value* overflow = fields.take("overflow")) {
    assign(reader.choice<rt::WhenFull>(*overflow, "overflow"), policy.when_full);
  }
  fields.refuse_others();
}

void read_policy_kind(const Value& value, const ValueReader& reader, ConnectionPolicy& policy) {
  if (value.kind == Value::Kind::kMap) {
    read_fifo(value, reader, policy);
  } else if (value.text == "fifo") {
    reader.error(value.where, "policy fifo needs its size", "for example {fifo: 8}");
  } else {
    reader.choice<bool>(value, "policy", {{"latest", true}});
  }
}

ConnectionPolicy read_policy(Fields& fields, const ValueReader& reader) {
  ConnectionPolicy policy;
  if (const Value* kind = fields.take("policy")) read_policy_kind(*kind, reader, policy);
  if (const Value* age = fields.take("max_age")) policy.max_age = reader.duration(*age, "max_age");
  if (const Value* on_old = fields.take("on_old")) {
    policy.on_old = reader.choice<Reaction>(*on_old, "on_old");
    if (fields.take("max_age") == nullptr) {
      reader.error(on_old->where, "on_old has no effect without max_age",
                   "for example max_age: 100 ms");
    }
  }
  if (const Value* on_lost = fields.take("on_lost")) {
    policy.on_lost = reader.choice<Reaction>(*on_lost, "on_lost");
  }
  if (const Value* delay = fields.take("delay")) {
    policy.one_cycle_delay =
        reader.choice<bool>(*delay, "delay", {{"one_cycle", true}}).has_value();
  }
  if (const Value* fan_in = fields.take("fan_in")) {
    assign(reader.flag(*fan_in, "fan_in"), policy.fan_in);
  }
  return policy;
}

std::optional<Connection> read_directed(const Value* from, const Value* to, const Value& value,
                                        const ValueReader& reader) {
  if (from == nullptr || to == nullptr) {
    reader.error(value.where, from == nullptr ? "it has no 'from'" : "it has no 'to'", kArrowHint);
    return std::nullopt;
  }
  std::optional<Endpoint> source = read_endpoint(*from, "from", reader);
  std::optional<Endpoint> sink = read_endpoint(*to, "to", reader);
  if (!source || !sink) return std::nullopt;
  return Connection{std::move(*source), std::move(*sink), {}, value.where};
}

std::string read_name(const Value& value, const ValueReader& reader) {
  std::optional<std::string> name = reader.text(value, "name");
  if (!name) return {};
  if (is_dotted_name(*name)) return std::move(*name);
  reader.error(value.where,
               "name must be a name of letters, digits, _ and -, found " + in_quotes(*name));
  return {};
}

std::vector<Property> read_parameters(const Value& value, const ValueReader& reader) {
  if (value.kind == Value::Kind::kMap) return value.entries;
  reader.error(value.where, "with must be a map, found " + std::string(name_of(value.kind)),
               "for example {on: Button.Pressed, do: Lift.travel, with: {height: 2 m}}");
  return {};
}

std::optional<NamedConnection> read_named(const Value* name, const Value& ports, const Value& value,
                                          const ValueReader& reader) {
  NamedConnection connection;
  connection.where = value.where;
  if (name != nullptr) {
    assign(reader.text(*name, "name"), connection.name);
  } else {
    reader.error(value.where, "ports that are connected by name need that 'name'");
  }
  for (const Value* port : items_of(&ports)) {
    if (auto endpoint = read_endpoint(*port, "ports", reader)) {
      connection.ports.push_back(std::move(*endpoint));
    }
  }
  return connection;
}

/// The other name that a mistyped one was probably meant to be.
base::Hint other_name_hint(const std::string& name, const std::vector<NamedConnection>& all) {
  std::vector<std::string> others;
  for (const NamedConnection& one : all) {
    if (one.name != name) others.push_back(one.name);
  }
  return base::near_hint(name, others);
}

void check_named(NamedConnection& connection, const std::vector<NamedConnection>& all,
                 const std::unordered_map<std::string, std::size_t>& order,
                 base::Diagnostics& diagnostics) {
  const ValueReader reader("connection " + in_quotes(connection.name), diagnostics);
  if (connection.ports.size() < 2) {
    reader.error(connection.where, "only one port has this name; nothing is connected",
                 other_name_hint(connection.name, all));
  }
  std::multimap<std::size_t, Endpoint> by_component;  // keeps the order within a component
  for (Endpoint& port : connection.ports) {
    const auto found = order.find(port.component);
    const std::size_t place = found == order.end() ? order.size() : found->second;
    by_component.emplace(place, std::move(port));
  }
  connection.ports.clear();
  for (auto& [place, port] : by_component) connection.ports.push_back(std::move(port));
  std::unordered_map<std::string, const Endpoint*> first;
  for (const Endpoint& port : connection.ports) {
    const auto [earlier, is_new] = first.emplace(to_text(port), &port);
    if (is_new) continue;
    reader.error(port.where, "port " + in_quotes(to_text(port)) + " is given twice",
                 "first at " + place_text(earlier->second->where));
  }
}

}  // namespace

void check_connections(Document& document, base::Diagnostics& diagnostics) {
  std::unordered_map<std::string, base::Location> first;
  std::erase_if(document.connections, [&](const Connection& one) {
    const std::string text =
        to_text(one.from) + " -> " + to_text(one.to) + (one.name.empty() ? "" : ", " + one.name);
    const auto [earlier, is_new] = first.emplace(text, one.where);
    if (is_new) return false;
    diagnostics.error(one.where, "connection " + in_quotes(text) + " is given twice",
                      "first at " + place_text(earlier->second));
    return true;
  });
  std::unordered_map<std::string, std::size_t> order;
  for (const Component& component : document.components) {
    order.emplace(component.name, order.size());
  }
  for (NamedConnection& one : document.named_connections) {
    check_named(one, document.named_connections, order, diagnostics);
  }
}

std::optional<Value> connection_map(const Value& value, base::Diagnostics& diagnostics) {
  const ValueReader reader("connection", diagnostics);
  if (value.kind == Value::Kind::kMap) return with_ends(value);
  if (value.kind != Value::Kind::kText) {
    reader.error(value.where, "expected text or a map, found " + std::string(name_of(value.kind)),
                 kArrowHint);
    return std::nullopt;
  }
  constexpr std::string_view kArrow = "->";
  const std::string& text = value.text;
  const std::size_t arrow = text.find(kArrow);
  const bool one = arrow != std::string::npos && text.find(kArrow, arrow + 1) == std::string::npos;
  if (!one) {
    reader.error(value.where,
                 in_quotes(text) + " must have the form component.port -> component.port",
                 kArrowHint);
    return std::nullopt;
  }
  Value map = make_map(value.where);
  map.entries.push_back({"from", part_of(value, 0, arrow), {}, value.where});
  map.entries.push_back(
      {"to", part_of(value, arrow + kArrow.size(), text.size()), {}, value.where});
  return map;
}

std::optional<std::variant<Connection, NamedConnection>> read_connection(
    const Value& map, base::Diagnostics& diagnostics) {
  const ValueReader reader("connection", diagnostics);
  Fields fields(map, reader);
  const Value* ports = fields.take("ports");
  const Value* name = fields.take("name");
  const Value* from = fields.take("from");
  const Value* to = fields.take("to");
  const Value* with = fields.take("with");
  const ConnectionPolicy policy = read_policy(fields, reader);
  fields.refuse_others();
  if (ports != nullptr && (from != nullptr || to != nullptr)) {
    reader.error(map.where, "it has both ends, from and to, and a name with ports",
                 "write from and to, or name and ports");
  }
  if (ports != nullptr) {
    std::optional<NamedConnection> named = read_named(name, *ports, map, reader);
    if (named) named->policy = policy;
    return named;
  }
  std::optional<Connection> directed = read_directed(from, to, map, reader);
  if (!directed) return std::nullopt;
  directed->policy = policy;
  if (name != nullptr) directed->name = read_name(*name, reader);
  if (with != nullptr) directed->with = read_parameters(*with, reader);
  return directed;
}

std::optional<Connection> read_input(const Value& value, const ValueReader& reader) {
  Connection connection;
  const Value* to = &value;
  if (value.kind == Value::Kind::kMap) {
    Fields fields(value, reader);
    to = fields.take("to");
    connection.policy = read_policy(fields, reader);
    fields.refuse_others();
  }
  if (to == nullptr) {
    reader.error(value.where, "it has no 'to'", "for example {to: Arm.reference, max_age: 100 ms}");
    return std::nullopt;
  }
  std::optional<Endpoint> input = read_endpoint(*to, "inputs", reader);
  if (!input) return std::nullopt;
  connection.from = {kNetworkName, to_text(*input), value.where};
  connection.to = std::move(*input);
  connection.where = value.where;
  return connection;
}

}  // namespace armature::document
