// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>

#include "tests/configurations/mutation_kinds.hpp"

namespace armature::configurations {

using document::Document;

namespace {

std::string text_of(const document::Connection& connection) {
  return connection.from.component + "." + connection.from.port + " -> " + connection.to.component +
         "." + connection.to.port;
}

}  // namespace

std::optional<std::string> change_wire(Document& document, Random& random) {
  auto& all = document.connections;
  if (all.empty()) return std::nullopt;
  document::Connection& one = any_of(all, random);
  document::Connection& other = any_of(all, random);
  const std::string was = text_of(one);
  switch (random() % 6) {
    case 0:
      std::swap(one.to, other.to);
      return was + " and " + text_of(other) + ": swapped";
    case 1: {  // between equal ports, which fit
      for (document::Connection& like : all) {
        const bool alike = like.from.component != one.from.component && &like != &one &&
                           like.to.component.substr(0, 3) == one.to.component.substr(0, 3);
        if (!alike || random() % 2 == 0) continue;
        std::swap(one.to, like.to);
        return was + " now to " + text_of(one);
      }
      return std::nullopt;
    }
    case 2:
      all.erase(all.begin() + (&one - all.data()));
      return was + ": removed";
    case 3: {
      document::Connection doubled = one;
      doubled.to = other.to;
      doubled.policy.fan_in = random() % 2 == 0;
      all.push_back(doubled);
      return text_of(doubled) + ": added";
    }
    case 4:
      one.policy.max_age = std::chrono::seconds(100);
      one.policy.on_old = document::Reaction::kHold;
      one.policy.on_lost = document::Reaction::kHold;
      return was + ": old data is held";
    default:
      one.policy.one_cycle_delay = true;
      return was + ": one cycle later";
  }
}

std::optional<std::string> change_peers(Document& document, Random& random) {
  if (document.components.empty()) return std::nullopt;
  document::Component& component = any_of(document.components, random);
  if (component.peers.empty()) return std::nullopt;
  document::Peer& peer = any_of(component.peers, random);
  const std::string was = component.name + ": peer " + peer.component;
  if (random() % 2 == 0) {
    component.peers.erase(component.peers.begin() + (&peer - component.peers.data()));
    return was + ": removed";
  }
  peer.component = any_of(document.components, random).name;
  peer.name = peer.component;
  return was + " -> " + peer.component;
}

}  // namespace armature::configurations
