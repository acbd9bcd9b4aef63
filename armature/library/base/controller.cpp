// SPDX-License-Identifier: Apache-2.0
#include "armature/library/base/controller.hpp"

#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/library/base/of_this_run.hpp"

namespace armature::library {

using component::Outcome;
using control::ReferenceBrake;

Outcome Controller::on_configure() { return set_up(); }

Outcome Controller::on_start() {
  if (changes_.take()) {
    if (Outcome outcome = set_up(); !outcome) return outcome;
  }
  started_ = time();
  followed_ = base::Time::min();
  late_ = false;
  braking_ = false;
  hand_over_.reset();
  const std::vector<double>* const present = act_.taken_over();
  takes_over_ = present != nullptr && hand_over_.begin(*present);
  sampled_ = false;
  samples_without_sensor_.assign(0);
  brakings_.assign(0);
  return component::accepted();
}

Outcome Controller::set_up() {
  const auto joints = static_cast<std::size_t>(joints_.get());
  hand_over_ = control::HandOver(joints);
  handed_over_.assign(joints, 0.0);
  motion_.assign(3 * joints, 0.0);
  brake_.reset();
  changes_.take();
  if (max_acceleration_.get().empty()) return component::accepted();
  auto made = ReferenceBrake::make({.joints = joints,
                                    .max_acceleration = max_acceleration_,
                                    .period = base::from_seconds(period_)});
  if (!made) return component::refused(made.error());
  brake_ = std::move(made.value());
  return component::accepted();
}

void Controller::sample_now() {
  if (std::exchange(sampled_, true)) samples_without_sensor_.assign(samples_without_sensor_ + 1);
}

const std::vector<double>* Controller::reference_now(const std::vector<double>& measured) {
  if (std::exchange(takes_over_, false)) take_over_reference(measured);
  const auto reference = reference_.read();
  const bool came = is_of_this_run(reference, started_);
  const bool usable =
      came && !reference.stale && (!braking_ || brake_->may_give_way_to(reference.value, measured));
  if (usable && std::exchange(braking_, false)) log_info("follows its reference again");
  if (usable && (!brake_ || reference.time > followed_)) {
    followed_ = reference.time;
    late_ = false;
    return &reference.value;
  }
  if (usable) {
    if (!std::exchange(late_, true)) brake_->begin(reference.value);
    return &brake_->step();  // so that it is smooth if this was the last one
  }
  if (braking_) return &brake_->step();
  const bool waited_too_long = reference_.ages() && time() - started_ > reference_.max_age();
  if (!came && !waited_too_long) return nullptr;
  if (!came || !brake_) {
    stop_because("input 'reference': its data is older than declared");
    return nullptr;
  }
  begin_to_brake(reference.value);
  return &brake_->step();
}

/// What was desired before counts, unless the controller before did not follow it any more.
void Controller::take_over_reference(const std::vector<double>& measured) {
  constexpr double kFar = 0.05;  // more than a controller that follows leaves
  const auto joints = static_cast<std::size_t>(joints_.get());
  const auto reference = reference_.read();
  bool followed = static_cast<bool>(reference);
  for (std::size_t i = 0; brake_ && followed && i < joints; ++i) {
    followed = std::abs(reference.value[i] - measured[i]) <= kFar;
  }
  if (followed) {
    started_ = reference.time;
  } else if (brake_) {
    for (std::size_t i = 0; i < joints; ++i) {
      motion_[i] = measured[i];
      motion_[joints + i] = measured[joints + i] / period_;
    }
    begin_to_brake(motion_);
  }
}

void Controller::begin_to_brake(const std::vector<double>& last) {
  braking_ = true;
  brakings_.assign(brakings_ + 1);
  if (!std::exchange(late_, false)) brake_->begin(last);
  log_warning(
      "the reference is older than declared: brakes, and holds until there is one that rests where "
      "the joints are");
}

}  // namespace armature::library
