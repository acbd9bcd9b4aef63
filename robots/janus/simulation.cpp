// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulation.hpp"

#include <algorithm>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "armature/base/diagnostic.hpp"

namespace armature::janus {

base::Result<std::unique_ptr<Simulation>> Simulation::make(const Config& config) {
  auto head = config.urdf.empty() ? Head::load(config.head) : Head::parse(config.urdf, config.head);
  if (!head) return base::Error{head.error()};
  std::unique_ptr<Simulation> made(new Simulation(std::move(head).value(), config));
  base::Diagnostics diagnostics;
  for (const auto& card : made->cards_) {
    if (!card->power_on(diagnostics)) return base::Error{base::as_reason(diagnostics)};
  }
  return made;
}

Simulation::Simulation(std::unique_ptr<Head> head, const Config& config)
    : head_(std::move(head)),
      bus_(
          config.bus_name, config.bit_rate,
          config.clock ? config.clock : [this] { return bus_.now(); }) {
  bus_.advance_to(config.head.begin);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    const int number = static_cast<int>(joint) + 1;
    cards_[joint] = std::make_unique<AicFirmware>(number, bus_, head_->wiring(joint));
  }
}

void Simulation::advance_to(base::Time until) {
  do {
    advance_to_next_event(until);
  } while (bus_.now() < until);
}

void Simulation::advance_to_next_event(base::Time until) {
  bus_.advance_to(std::min(next_event(), until));
  for (const auto& card : cards_) card->run_timers();
  head_->advance_to(bus_.now());
}

/// One event after the other, because each may move a card's deadlines.
base::Time Simulation::next_event() {
  base::Time next = bus_.next_event().value_or(base::Time::max());
  for (const auto& card : cards_) next = std::min(next, card->next_deadline());
  return next;
}

}  // namespace armature::janus
