// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <vector>

#include "tests/configurations/mutation_kinds.hpp"

namespace armature::configurations {

using document::Document;

namespace {

/// Of a component, or of the one that writes what others send.
std::string any_name(Document& document, Random& random) {
  if (document.components.empty()) return "nobody";
  return any_of(document.components, random).name;
}

std::string replace(document::Reference& reference, const std::string& name) {
  std::string what = reference.name + " -> " + name;
  reference.name = name;
  return what;
}

std::optional<std::string> change_placeholder(Document& document, Random& random) {
  std::vector<document::Component*> remote;
  for (document::Component& each : document.components) {
    if (!each.remote.name.empty()) remote.push_back(&each);
  }
  if (remote.empty()) return std::nullopt;
  document::Component& one = *any_of(remote, random);
  constexpr std::array<const char*, 5> kPlaces{"", "unix:nowhere.sock/Arming",
                                               "tcp://0.0.0.0:1/Generator",
                                               "tls://localhost/Arming", "unix:janus.sock"};
  return one.name + ".remote: " + replace(one.remote, any_of(kPlaces, random));
}

}  // namespace

std::optional<std::string> change_grants(Document& document, Random& random) {
  constexpr std::array<const char*, 9> kActs{"arm",          "disarm",      "actuatorOn",
                                             "brakeRelease", "actuatorOff", "brakeApply",
                                             "start",        "at_home",     "shiftActivate"};
  const std::string name = any_name(document, random);
  const char* const act = any_of(kActs, random);
  const bool remote = random() % 4 == 0;
  auto& grants = remote ? document.remote_grants : document.script_grants;
  if (random() % 4 == 0 && !grants.empty()) {
    grants.clear();
    return remote ? "grants of others: empty" : "grants of scripts: empty";
  }
  if (random() % 4 == 0) document.grants_on_hardware = true;
  grants.push_back({name, act, {}});
  return "grants: " + name + "." + act + (document.grants_on_hardware ? ", on hardware too" : "");
}

std::optional<std::string> change_stop(Document& document, Random& random) {
  switch (random() % 4) {
    case 0:
      if (document.before_stop.empty()) return std::nullopt;
      document.before_stop.clear();
      return "before_stop: empty";
    case 1: {
      const std::string name = any_name(document, random);
      document.before_stop.push_back({name, random() % 2 == 0 ? "moveHome" : "stop", {}});
      return "before_stop: " + name + " too";
    }
    case 2:
      document.hold_at_stop = std::chrono::milliseconds(random() % 2 == 0 ? 0 : 3'600'000);
      return "hold_at_stop: " + document::to_text(*document.hold_at_stop);
    default:
      document.on_fault =
          random() % 2 == 0 ? document::OnFault::kKeepRunning : document::OnFault::kStopAll;
      return "on_fault: " + std::string(types::name_of(document.on_fault));
  }
}

std::optional<std::string> change_modes(Document& document, Random& random) {
  if (document.modes.empty()) return std::nullopt;
  document::Mode& mode = any_of(document.modes, random);
  if (mode.components.empty()) return std::nullopt;
  switch (random() % 5) {
    case 0: {
      const auto at = static_cast<std::ptrdiff_t>(below(mode.components.size(), random));
      const std::string name = mode.components[static_cast<std::size_t>(at)].name;
      mode.components.erase(mode.components.begin() + at);
      return "mode " + mode.name + ": without " + name;
    }
    case 1: {
      const std::string name = any_name(document, random);
      mode.components.push_back({name, {}});
      return "mode " + mode.name + ": " + name + " too";
    }
    case 2: {
      const std::string name = mode.name;
      document.modes.erase(document.modes.begin() + (&mode - document.modes.data()));
      return "mode " + name + ": removed";
    }
    case 3:
      document.mode.name = mode.name;
      return "mode: begins in " + mode.name;
    default: {
      document::Mode& other = any_of(document.modes, random);
      if (&mode == &other || other.components.empty()) return std::nullopt;
      std::swap(any_of(mode.components, random), any_of(other.components, random));
      return "modes " + mode.name + " and " + other.name + ": members swapped";
    }
  }
}

std::optional<std::string> change_network(Document& document, Random& random) {
  document::Network& network = document.network;
  if (network.listen.empty()) return change_placeholder(document, random);
  switch (random() % 8) {
    case 0:
      return "policy: " + replace(network.policy, "");
    case 1:
      return "policy: " +
             replace(network.policy, random() % 2 == 0 ? "nowhere.policy" : "pid.yaml");
    case 2: {
      constexpr std::array<const char*, 4> kAddresses{"tcp://0.0.0.0:4242", "unix:", "tcp://:-1",
                                                      "tls://localhost:4243"};
      return "listen: " + replace(any_of(network.listen, random), any_of(kAddresses, random));
    }
    case 3:
      network.memory_kb = random() % 2 == 0 ? 1 : 1'000'000'000;
      return "memory_kB: " + std::to_string(*network.memory_kb);
    case 4:
      network.socket_mode = random() % 2 == 0 ? 0777 : 0;
      return "socket_mode: " + std::to_string(*network.socket_mode);
    case 5: {
      if (document.connections.empty()) return std::nullopt;
      document::Connection input = any_of(document.connections, random);
      input.from.component = document::kNetworkName;
      input.from.port.clear();
      network.inputs.push_back(input);
      return "inputs: " + input.to.component + "." + input.to.port;
    }
    case 6:
      network.serving = document::Serving{random() % 2 == 0 ? 1 : 99, 1, {}};
      return "serving: most " + std::to_string(network.serving->most);
    default:
      network.listen.clear();
      return "listen: nowhere";
  }
}

std::optional<std::string> change_bus(Document& document, Random& random) {
  struct Place {
    std::string name;
    std::string* text;
  };
  std::vector<Place> places;
  for (document::Component& component : document.components) {
    for (document::Property& property : component.properties) {
      const bool is_of_bus = is_one_of(property.name, {"bus", "mode", "guardian", "PeerName"});
      if (is_of_bus) places.push_back({component.name + "." + property.name, &property.value.text});
    }
  }
  if (places.empty()) return std::nullopt;
  const Place& place = any_of(places, random);
  constexpr std::array<const char*, 9> kWords{
      "can0", "emulator", "virtual:/tmp/none", "sequential", "synchronous", "off", "required",
      "",     "AIC1"};
  const std::string word = any_of(kWords, random);
  if (*place.text == word) return std::nullopt;
  std::string what = place.name + ": " + *place.text + " -> " + word;
  *place.text = word;
  return what;
}

}  // namespace armature::configurations
