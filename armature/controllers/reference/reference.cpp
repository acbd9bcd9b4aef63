// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/reference/reference.hpp"

#include <cstddef>
#include <utility>

namespace armature::controllers {

using component::CommandStage;
using component::Outcome;

Outcome Reference::on_start() {
  const auto joints = static_cast<std::size_t>(joints_.get());
  if (position_.get().size() != joints) position_.assign(Vector(joints, 0.0));
  position_known_ = false;
  motion_ = component::CommandHandle(component::CallStatus::kNotConnected);
  return component::accepted();
}

void Reference::on_measured(const std::vector<double>& positions) {
  if (!std::exchange(position_known_, true)) position_.assign(positions);
  if (move_.active()) follow_motion();
}

Outcome Reference::begin_move() {
  if (!position_known_)
    return component::refused(
        "the positions of the joints are not known yet: try again in the next cycle");
  motion_ = generator_.send(position_.get(), time_);
  if (motion_.stage() == CommandStage::kRefused) return component::refused(motion_.reason());
  return component::accepted();
}

void Reference::follow_motion() {
  move_.report(motion_.progress());
  if (!motion_.ended()) return;
  if (motion_.stage() == CommandStage::kDone) {
    move_.complete();
  } else {
    move_.fail(motion_.reason());
  }
}

}  // namespace armature::controllers
