// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "armature/exec/event_command.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

/// Looks for a way by which a component leads back to itself, from peer to peer downwards (paper 4,
/// section II.A: each component relies on its subordinates alone). What gives a command for an
/// event is a connection: nobody's superior.
class SuperiorCheck {
 public:
  SuperiorCheck(const Blueprint& blueprint, const Directory& directory,
                base::Diagnostics& diagnostics)
      : blueprint_(blueprint),
        directory_(directory),
        diagnostics_(diagnostics),
        states_(blueprint.components.size(), State::kNew) {}

  void run() {
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      if (states_[i] == State::kNew) visit(i);
    }
  }

 private:
  enum class State { kNew, kOnTheWay, kDone };
  struct Place {
    Index component;
    std::size_t next = 0;  ///< of its peers
  };

  const std::vector<PeerEntry>& peers_of(Index component) const {
    static const std::vector<PeerEntry> kNobody{};
    const ComponentEntry& entry = blueprint_.components[component];
    const bool wire = dynamic_cast<const EventCommand*>(entry.component.get()) != nullptr;
    return wire ? kNobody : entry.peers;
  }
  const std::string& name_of(Index component) const {
    return blueprint_.components[component].component->name();
  }

  /// Depth first, without a stack of calls: a chain of peers may be long.
  void visit(Index first) {
    way_.assign(1, {first});
    states_[first] = State::kOnTheWay;
    while (!way_.empty()) {
      const Index here = way_.back().component;
      const std::vector<PeerEntry>& peers = peers_of(here);
      if (way_.back().next == peers.size()) {
        states_[here] = State::kDone;
        way_.pop_back();
        continue;
      }
      const PeerEntry& peer = peers[way_.back().next++];
      const Index to = directory_.component(peer.name);
      if (peer.superior || to == kNone || to == here || states_[to] == State::kDone) continue;
      if (states_[to] == State::kOnTheWay) {
        report(to, peer);
        continue;
      }
      states_[to] = State::kOnTheWay;
      way_.push_back({to});
    }
  }

  /// The one that was looked at last has `superior`, which leads to it, as a peer.
  void report(Index superior, const PeerEntry& peer) {
    const Index here = way_.back().component;
    std::string way;
    auto place = std::ranges::find(way_, superior, &Place::component);
    for (; place != way_.end(); ++place) way += quoted(name_of(place->component)) + " -> ";
    diagnostics_.error(
        peer.where,
        quoted(name_of(here)) + " uses " + quoted(name_of(superior)) +
            ", which uses it: peers form a circle, " + way + quoted(name_of(superior)),
        "if that is meant, list the one that commands: superiors: [" + name_of(superior) + "]");
  }

  const Blueprint& blueprint_;
  const Directory& directory_;
  base::Diagnostics& diagnostics_;
  std::vector<State> states_;
  std::vector<Place> way_;
};

}  // namespace

void check_superiors(const Blueprint& blueprint, const Directory& directory,
                     base::Diagnostics& diagnostics) {
  SuperiorCheck(blueprint, directory, diagnostics).run();
}

}  // namespace armature::exec::internal
