// SPDX-License-Identifier: Apache-2.0
#include "armature/library/arming/arming.hpp"

#include <cmath>

#include "armature/base/seconds.hpp"
#include "armature/library/base/missing_answers.hpp"
#include "armature/library/base/of_this_run.hpp"
#include "armature/library/base/reason_text.hpp"

namespace armature::library {

using component::Outcome;

Outcome Arming::on_start() {
  phase_ = Phase::kDisarmed;
  started_ = time();
  armed_.assign(false);
  return component::accepted();
}

void Arming::on_stop() { disarm(); }

void Arming::on_update() {
  switch (phase_) {
    case Phase::kDisarmed:
      return;
    case Phase::kSettling:
      return wait_for_reference();
    case Phase::kArming:
      return wait_for_joints();
    case Phase::kArmed:
      return watch();
  }
}

Outcome Arming::begin_to_arm() {
  if (phase_ == Phase::kArmed) return component::refused("the joints are armed already");
  if (!is_of_this_run(measured_.read(), started_)) {
    return component::refused("nothing was measured yet");
  }
  phase_ = Phase::kSettling;
  since_ = time();
  settle_event_.raise();
  return component::accepted();
}

/// What was desired before Settle says nothing.
void Arming::wait_for_reference() {
  const auto& measured = measured_.read();
  const auto& desired = desired_.read();
  const auto& velocity = desired_velocity_.read();
  const bool fresh = desired && desired.time > since_ && velocity && velocity.time > since_;
  if (fresh && measured) {
    const std::size_t apart = first_apart(measured.value, desired.value, velocity.value);
    if (apart == joints()) {
      phase_ = Phase::kArming;
      since_ = time();
      return static_cast<void>(arm_event_.raise());
    }
    if (!out_of_patience()) return;
    component::Reason why("joint ");
    append_number(why, static_cast<double>(apart + 1)).append(" is at ");
    append_number(why, measured.value[apart]).append(" rad, its reference at ");
    return give_up(append_number(why, desired.value[apart]).append(" rad"));
  }
  if (out_of_patience()) give_up("no reference came; is a generator running?");
}

void Arming::wait_for_joints() {
  const std::size_t missing = first_disarmed();
  if (missing == joints()) {
    phase_ = Phase::kArmed;
    armed_.assign(true);
    arm_.complete();
  } else if (out_of_patience()) {
    component::Reason why(writer_of(joint_armed_[missing]));
    give_up(why.append(" did not arm; its log line says why"));
  }
}

void Arming::watch() {
  const std::size_t lost = first_disarmed();
  if (lost == joints()) return;
  log_error("{} is disarmed, so all are", writer_of(joint_armed_[lost]));
  disarm();
}

void Arming::give_up(std::string_view why) {
  phase_ = Phase::kDisarmed;
  arm_.fail(why);
  disarm();
}

void Arming::disarm() {
  if (phase_ == Phase::kSettling || phase_ == Phase::kArming) arm_.fail("disarmed");
  phase_ = Phase::kDisarmed;
  armed_.assign(false);
  disarm_event_.raise();
}

bool Arming::out_of_patience() const { return base::to_seconds(time() - since_) > patience_; }

std::size_t Arming::first_disarmed() {
  std::size_t joint = 0;
  while (joint < joints()) {
    const auto armed = joint_armed_[joint].read();
    if (!is_of_this_run(armed, started_) || !armed.value) break;
    ++joint;
  }
  return joint;
}

std::size_t Arming::first_apart(const std::vector<double>& measured,
                                const std::vector<double>& desired,
                                const std::vector<double>& velocity) const {
  std::size_t joint = 0;
  while (joint < joints() && std::abs(desired[joint] - measured[joint]) <= tolerance_ &&
         velocity[joint] == 0.0) {
    ++joint;
  }
  return joint;
}

}  // namespace armature::library
