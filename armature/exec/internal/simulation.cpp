// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/simulation.hpp"

#include <algorithm>
#include <utility>

namespace armature::exec::internal {
namespace {

/// So many turns of each thread at one instant mean that threads trigger each other without end.
constexpr std::uint64_t kTurnsAtOneInstant = 10'000;

}  // namespace

Simulation::Simulation(const std::vector<Engine*>& engines) : by_urgency_(engines) {
  std::stable_sort(by_urgency_.begin(), by_urgency_.end(), [](const Engine* a, const Engine* b) {
    return urgency(a->activity()) > urgency(b->activity());
  });
}

Engine* Simulation::take_turn(base::Time now) {
  Engine* const engine = find_next(now);
  if (engine == nullptr) return nullptr;
  if (std::exchange(instant_, now) != now) turns_at_instant_ = 0;
  if (++turns_at_instant_ > kTurnsAtOneInstant * by_urgency_.size()) {
    turns_at_instant_ = 0;
    engine->fault_members("simulated time stands still: threads trigger each other without end");
  }
  engine->step(now);
  return engine;
}

Engine* Simulation::find_next(base::Time now) const {
  for (Engine* engine : by_urgency_) {
    if (engine->has_messages() || engine->next_due() <= now) return engine;
  }
  return nullptr;
}

base::Time Simulation::next_due() const {
  base::Time earliest = base::Time::max();
  for (const Engine* engine : by_urgency_) earliest = std::min(earliest, engine->next_due());
  return earliest;
}

}  // namespace armature::exec::internal
