// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/items.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <memory>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"
#include "armature/types/elements.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using exec::Application;

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_character(char c) {
  return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

template <typename Items>
auto find_in(const Items& items, std::string_view name) -> typename Items::value_type {
  for (auto* item : items) {
    if (item->name() == name) return item;
  }
  return nullptr;
}

/// Finds the member that the rest of a text behind its component begins with, and takes it away.
base::Result<Member> take_member(const Component& component, std::string_view& rest) {
  if (rest.size() < 2) return base::Error{"'" + component.name() + "' is a component"};
  rest.remove_prefix(1);
  std::size_t size = 0;
  while (size < rest.size() && is_name_character(rest[size])) ++size;
  const std::string_view name = rest.substr(0, size);
  const std::optional<Member> member = member_of(component, name);
  if (!member) {
    return base::Error{"'" + component.name() + "' has no '" + std::string(name) + "'" +
                       base::suggestion_in_brackets(name, member_names(component))};
  }
  rest.remove_prefix(size);
  return *member;
}

bool take_index(std::string_view& rest, Item& item) {
  std::size_t index = 0;
  const char* const end = rest.data() + rest.size();
  const auto read = std::from_chars(rest.data() + 1, end, index);
  if (read.ec != std::errc{} || read.ptr == end || *read.ptr != ']' || index == 0) return false;
  if (!types::is_list(*item.type)) return false;
  if (item.type->kind == types::Kind::kArray && index > item.type->count) return false;
  rest.remove_prefix(static_cast<std::size_t>(read.ptr - rest.data()) + 1);
  item.parts.emplace_back(index - 1);
  item.type = item.type->element;
  return true;
}

bool take_field(std::string_view& rest, Item& item) {
  std::size_t size = 1;
  while (size < rest.size() && is_name_character(rest[size])) ++size;
  const std::string_view name = rest.substr(1, size - 1);
  for (const types::Field& field : item.type->fields) {
    if (field.name != name) continue;
    item.parts.emplace_back(&field);
    item.type = field.type;
    item.unit = field.unit;
    rest.remove_prefix(size);
    return true;
  }
  return false;
}

/// Whether a path is `part`, or leads on from there.
bool lies_in(std::string_view path, std::string_view part) {
  if (!path.starts_with(part)) return false;
  const std::string_view rest = path.substr(part.size());
  return rest.empty() || rest.front() == '[' || rest.front() == '.';
}

}  // namespace

Component* leading_component(const Application& application, std::string_view text,
                             std::string_view separators) {
  for (std::size_t size = text.size(); size > 0; --size) {
    const bool ends = size == text.size() || separators.find(text[size]) != std::string_view::npos;
    if (!ends) continue;
    if (Component* const found = application.find(text.substr(0, size))) return found;
  }
  return nullptr;
}

std::vector<std::string> component_names(const Application& application) {
  std::vector<std::string> names;
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    names.push_back(entry.component->name());
  }
  return names;
}

std::string no_component(const Application& application, std::string_view text) {
  return "unknown component '" + std::string(text) + "'" +
         base::suggestion_in_brackets(text, component_names(application));
}

std::vector<std::string> member_names(const Component& component) {
  const component::Interface& interface = component::interface_of(component);
  std::vector<std::string> names;
  const auto add = [&](const auto& items) {
    for (const auto* item : items) names.emplace_back(item->name());
  };
  add(interface.properties);
  add(interface.inputs);
  add(interface.outputs);
  for (const auto* operation : interface.operations) {
    if (operation->is_offered()) names.emplace_back(operation->name());
  }
  add(interface.events);
  return names;
}

std::optional<Member> member_of(const Component& component, std::string_view name) {
  const component::Interface& interface = component::interface_of(component);
  Member member;
  member.component = &component;
  const auto found_in = [name](const auto& items, auto& place) {
    place = find_in(items, name);
    return place != nullptr;
  };
  const bool found =
      found_in(interface.properties, member.property) || found_in(interface.inputs, member.input) ||
      found_in(interface.outputs, member.output) ||
      found_in(interface.operations, member.operation) || found_in(interface.events, member.event);
  return found ? std::optional(member) : std::nullopt;
}

std::string Member::name() const {
  std::string_view own;
  if (property != nullptr) own = property->name();
  if (port() != nullptr) own = port()->name();
  if (operation != nullptr) own = operation->name();
  if (event != nullptr) own = event->name();
  return component->name() + (operation != nullptr ? ":" : ".") + std::string(own);
}

const component::PortBase* Member::port() const {
  if (input != nullptr) return input;
  return output;
}

const types::Type& Member::type() const {
  return property != nullptr ? property->type() : port()->type();
}

std::string_view Member::unit() const {
  return property != nullptr ? property->unit() : port()->unit();
}

base::Result<Member> find_member(const Application& application, std::string_view text) {
  const std::string plain(text);
  std::string_view rest = plain;
  const Component* const component = leading_component(application, rest, ".:");
  if (component == nullptr) {
    return base::Error{no_component(application, rest.substr(0, rest.find_first_of(".:")))};
  }
  rest.remove_prefix(component->name().size());
  base::Result<Member> member = take_member(*component, rest);
  if (member && !rest.empty()) {
    return base::Error{"'" + member.value().name() + "' has no '" + std::string(rest) + "'"};
  }
  return member;
}

base::Result<Item> find_item(const Application& application, std::string_view text) {
  const std::string plain(text);
  std::string_view rest = plain;
  const Component* const component = leading_component(application, rest, ".:");
  if (component == nullptr) {
    return base::Error{no_component(application, rest.substr(0, rest.find_first_of(".:[")))};
  }
  rest.remove_prefix(component->name().size());
  if (rest.starts_with(':')) return base::Error{"'" + plain + "' has no value"};
  const base::Result<Member> member = take_member(*component, rest);
  if (!member) return base::Error{member.error()};
  if (!member.value().has_value()) {
    return base::Error{"'" + member.value().name() + "' has no value to look at"};
  }
  Item item{plain, member.value(), {}, &member.value().type(), std::string(member.value().unit())};
  while (!rest.empty()) {
    const bool taken = (rest.front() == '[' && take_index(rest, item)) ||
                       (rest.front() == '.' && take_field(rest, item));
    if (!taken) {
      return base::Error{"'" + plain.substr(0, plain.size() - rest.size()) + "' is a " +
                         item.type->name + " and has no '" + std::string(rest) + "'"};
    }
  }
  return item;
}

Reading room_for(const Member& member) { return {types::Value(member.type())}; }

void take_reading(const Member& member, base::Time now, Reading& to) {
  const component::PortBase* const port = member.port();
  const void* const data = port == nullptr ? member.property->data() : port->current();
  to.whole.type().assign(to.whole.data(), data);
  if (port == nullptr) return;
  to.sequence = port->current_sequence();
  to.written = to.sequence > 0;
  to.age = to.written ? std::max(now - port->current_time(), base::Duration::zero())
                      : base::Duration::zero();
}

std::optional<std::vector<Reading>> read_members(Application& application,
                                                 const std::vector<Member>& members) {
  auto readings = std::make_shared<std::vector<Reading>>();
  if (members.empty()) return *readings;
  for (const Member& member : members) readings->push_back(room_for(member));
  const auto read = [readings, members, now = application.now()] {
    for (std::size_t i = 0; i < members.size(); ++i) take_reading(members[i], now, (*readings)[i]);
  };
  Component* const component = application.find(members.front().component->name());
  if (!application.run_in_thread_of(*component, read)) return std::nullopt;
  return *readings;
}

base::Result<std::vector<WatchedPlace>> numbers_in(Application& application,
                                                   std::string_view text) {
  const auto item = find_item(application, text);
  if (!item) return base::Error{item.error()};
  const Member& member = item.value().member;
  const auto readings = read_members(application, {member});
  if (!readings) {
    return base::Error{"the thread of '" + member.component->name() + "' does not answer"};
  }
  const std::string part = item.value().text.substr(member.name().size());
  Component* const component = application.find(member.component->name());
  std::vector<WatchedPlace> places;
  for (types::NumberPlace& place :
       types::NumberPlace::all_in(member.type(), readings->front().whole.data())) {
    if (!lies_in(place.path(), part)) continue;
    const std::string name = member.name() + place.path();
    places.push_back({name,
                      find_item(application, name).value().unit,
                      {component, member.port(), member.property, std::move(place)}});
  }
  if (places.empty()) {
    return base::Error{"'" + std::string(text) + "' has no numbers to watch: it is a " +
                       item.value().type->name};
  }
  return places;
}

const void* part_of(const Item& item, const types::Value& whole) {
  const types::Type* type = &whole.type();
  const void* data = whole.data();
  for (const Item::Part& part : item.parts) {
    if (const auto* const index = std::get_if<std::size_t>(&part)) {
      if (*index >= types::element_count(*type, data)) return nullptr;
      data = types::at_offset(types::elements(*type, data), *index * type->element->size);
      type = type->element;
    } else {
      const types::Field& field = *std::get<const types::Field*>(part);
      data = types::at_offset(data, field.offset);
      type = field.type;
    }
  }
  return data;
}

}  // namespace armature::inspect
