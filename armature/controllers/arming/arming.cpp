// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/arming/arming.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/missing_answers.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::Outcome;

namespace {

/// For which what is desired has to rest before the joints are to stand.
constexpr base::Duration kRestTime = std::chrono::milliseconds(100);

}  // namespace

Outcome Arming::on_configure() {
  last_desired_.assign(joints(), 0.0);
  return component::accepted();
}

Outcome Arming::on_start() {
  last_desired_.resize(joints(), 0.0);
  phase_ = Phase::kDisarmed;
  started_ = time();
  tell_armed(false);
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
    return component::refused("nothing is measured yet: try again in the next cycle");
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
    if (!out_of_patience(patience_)) return;
    component::Reason why("joint ");
    append_number(why, static_cast<double>(apart + 1)).append(" is at ");
    append_number(why, measured.value[apart])
        .append(" ")
        .append(units_.position().get())
        .append(", its reference at ");
    return give_up(
        append_number(why, desired.value[apart]).append(" ").append(units_.position().get()));
  }
  if (out_of_patience(patience_)) give_up("no reference came: check that a generator is running");
}

void Arming::wait_for_joints() {
  const std::size_t missing = first_disarmed();
  if (missing == joints()) {
    phase_ = Phase::kArmed;
    tell_armed(true);
    rests_ = false;
    moved_at_ = time();
    arm_.complete();
  } else if (out_of_patience(joint_patience_)) {
    component::Reason why(writer_of(face(joint_armed_[missing])));
    give_up(why.append(" did not arm; its log line says why"));
  }
}

/// The first reason counts: what comes later may be its consequence.
void Arming::joint_does_not_arm(const ComponentName& joint, const component::Reason& why) {
  if (phase_ != Phase::kArming) return;
  component::Reason whole(joint.view());
  give_up(whole.append(" is not armed: ").append(why));
}

void Arming::watch() {
  const std::size_t lost = first_disarmed();
  if (lost == joints()) return watch_reference();
  log_error("{} is disarmed, so all are", writer_of(face(joint_armed_[lost])));
  disarm();
}

/// Whether the joints are to stand: what is desired has no velocity, and does not change.
void Arming::watch_reference() {
  const auto& desired = desired_.read();
  const auto& velocity = desired_velocity_.read();
  const bool rests = desired && velocity && desired.value == last_desired_ &&
                     std::ranges::all_of(velocity.value, [](double each) { return each == 0.0; });
  if (!rests) moved_at_ = time();
  if (desired) std::ranges::copy(desired.value, last_desired_.begin());
  const bool are_to_stand = time() - moved_at_ >= kRestTime;
  if (std::exchange(rests_, are_to_stand) == are_to_stand) return;
  static_cast<void>(are_to_stand ? rest_event_.raise() : motion_event_.raise());
}

void Arming::give_up(std::string_view why) {
  phase_ = Phase::kDisarmed;
  arm_.fail(why);
  disarm();
}

/// A joint that homes moves while nothing is armed.
void Arming::stop_moving() {
  stop_event_.raise();
  if (phase_ != Phase::kArmed) disarm();
}

void Arming::disarm() {
  if (phase_ == Phase::kSettling || phase_ == Phase::kArming) arm_.fail("disarmed");
  phase_ = Phase::kDisarmed;
  tell_armed(false);
  disarm_event_.raise();
}

void Arming::tell_armed(bool armed) {
  armed_.assign(armed);
  all_armed_ = armed;
}

bool Arming::out_of_patience(double patience) const {
  return base::to_seconds(time() - since_) > patience;
}

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

}  // namespace armature::controllers
