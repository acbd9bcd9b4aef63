// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/configurations/mutation_kinds.hpp"

namespace armature::configurations {

using document::Document;
using document::Property;

namespace {

/// Its connections too: otherwise the check finds what has no end.
void remove_component(Document& document, const std::string& name, bool with_its_connections) {
  std::erase_if(document.components, [&](const auto& each) { return each.name == name; });
  for (document::Component& each : document.components) {
    std::erase_if(each.peers, [&](const auto& peer) { return peer.component == name; });
  }
  if (!with_its_connections) return;
  std::erase_if(document.connections, [&](const document::Connection& each) {
    return each.from.component == name || each.to.component == name;
  });
}

std::optional<std::string> double_component(Document& document,
                                            const document::Component& component,
                                            bool with_its_connections) {
  document::Component copy = component;
  const std::string name = component.name;
  copy.name += "Again";
  std::vector<document::Connection> added;
  for (document::Connection each : document.connections) {
    if (each.from.component != name && each.to.component != name) continue;
    if (each.from.component == name) each.from.component = copy.name;
    if (each.to.component == name) each.to.component = copy.name;
    each.policy.fan_in = true;
    added.push_back(each);
  }
  document.components.push_back(std::move(copy));
  if (with_its_connections) {
    document.connections.insert(document.connections.end(), added.begin(), added.end());
  }
  return name + ": doubled" + (with_its_connections ? " with its connections" : "");
}

}  // namespace

std::optional<std::string> change_switch(Document& document, Random& random) {
  std::vector<std::pair<document::Component*, std::size_t>> switches;
  std::vector<std::pair<document::Component*, std::size_t>> all;
  for (document::Component& component : document.components) {
    for (std::size_t i = 0; i < component.properties.size(); ++i) {
      const Property& property = component.properties[i];
      if (is_of_the_plant(component, property.name)) continue;
      all.emplace_back(&component, i);
      if (is_one_of(property.value.text, {"true", "false"})) switches.emplace_back(&component, i);
    }
  }
  if (!switches.empty() && random() % 2 == 0) {
    const auto [component, i] = any_of(switches, random);
    Property& property = component->properties[i];
    const std::string was =
        std::exchange(property.value.text, property.value.text == "true" ? "false" : "true");
    return component->name + "." + property.name + ": " + was + " -> " + property.value.text;
  }
  if (all.empty()) return std::nullopt;
  const auto [component, i] = any_of(all, random);
  std::string what = component->name + "." + component->properties[i].name + ": left out";
  component->properties.erase(component->properties.begin() + static_cast<std::ptrdiff_t>(i));
  return what;
}

std::optional<std::string> change_activity(Document& document, Random& random) {
  if (document.components.empty()) return std::nullopt;
  document::Component& component = any_of(document.components, random);
  switch (random() % 6) {
    case 0:
      component.activity = {};
      return component.name + ": no activity";
    case 1:
      component.activity = {};
      component.activity.kind = exec::Activity::Kind::kPeriodic;
      component.activity.period = std::chrono::milliseconds(random() % 2 == 0 ? 2 : 50);
      return component.name + ": every " + document::to_text(component.activity.period);
    case 2:
      component.activity = {};
      component.activity.kind = exec::Activity::Kind::kTriggered;
      return component.name + ": triggered";
    case 3:
      component.activity.priority = static_cast<int>(1 + random() % 99);
      return component.name + ": priority " + std::to_string(component.activity.priority);
    case 4:
      component.autostart = false;
      return component.name + ": not started by itself";
    default:
      component.activity.scheduler = exec::Activity::Scheduler::kOther;
      component.activity.scheduler_given = true;
      return component.name + ": scheduler other";
  }
}

std::optional<std::string> change_components(Document& document, Random& random) {
  if (document.components.empty()) return std::nullopt;
  const document::Component component = any_of(document.components, random);
  const bool connections = random() % 4 != 0;
  if (random() % 2 == 0) return double_component(document, component, connections);
  remove_component(document, component.name, connections);
  return component.name + ": removed" + (connections ? " with its connections" : "");
}

/// Two of one model have each other's properties, or peers.
std::optional<std::string> swap_components(Document& document, Random& random) {
  if (document.components.empty()) return std::nullopt;
  document::Component& one = any_of(document.components, random);
  document::Component& other = any_of(document.components, random);
  if (one.name == other.name || one.model != other.model) return std::nullopt;
  if (random() % 2 == 0) {
    std::swap(one.properties, other.properties);
    return one.name + " and " + other.name + ": properties swapped";
  }
  std::swap(one.peers, other.peers);
  return one.name + " and " + other.name + ": peers swapped";
}

}  // namespace armature::configurations
