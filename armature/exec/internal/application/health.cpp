// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/health.hpp"

#include <utility>
#include <vector>

namespace armature::exec::internal {

void Health::begin_anew(const Blueprint& blueprint) {
  std::vector<const component::Component*> shadows;
  for (const ComponentEntry& entry : blueprint.components) {
    if (entry.shadow) shadows.push_back(entry.component.get());
  }
  incidents_ = std::make_unique<Incidents>(std::move(shadows));
  leaving_ = false;
}

bool Health::end_of_run() { return std::exchange(running_, false); }

bool Health::in_good_order() const {
  return running_ && incidents_->faults() == 0 && incidents_->reactions() == 0;
}

/// The dead thread stands still, so that its components are everybody's.
void Health::take_leave_of_the_dead(const Engines& engines) {
  const std::optional<DeathNotice::Death> death = death_notice_.take();
  if (!death) return;
  died_ = true;
  for (const auto& engine : engines) {
    if (&engine->context() != death->workplace) continue;
    unreachable_.give_up(engine->context());
    engine->fault_members(death->reason);
  }
}

std::optional<RunEnd> Health::end_by_fault(OnFault on_fault) const {
  if (died_) return RunEnd::kFaulted;
  if (on_fault != OnFault::kStopAll || leaving_) return std::nullopt;
  if (incidents_->faults() > 0) return RunEnd::kFaulted;
  if (incidents_->reactions() > 0) return RunEnd::kStoppedByReaction;
  return std::nullopt;
}

}  // namespace armature::exec::internal
