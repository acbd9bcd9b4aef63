// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/controller.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/controllers/base/of_this_run.hpp"

namespace armature::controllers {

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
  sampled_ = false;
  take_over();
  samples_without_sensor_.assign(0);
  sensor_without_sample_.assign(0);
  brakings_.assign(0);
  return component::accepted();
}

void Controller::on_check(component::Check& check) const {
  if (!max_acceleration_.get().empty()) period_.expect_known(check);
}

Outcome Controller::set_up() {
  const auto joints = static_cast<std::size_t>(joints_.get());
  hand_over_ = control::HandOver(joints);
  constexpr double kLately = 0.2;  // [s]
  const auto samples = static_cast<int>(std::clamp(kLately / period_, 20.0, 1000.0));
  lately_ = control::RestingMean(joints, samples);
  handed_over_.assign(joints, 0.0);
  motion_.assign(3 * joints, 0.0);
  brake_.reset();
  changes_.take();
  if (max_acceleration_.get().empty()) return component::accepted();
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  auto made = ReferenceBrake::make(
      {.joints = joints, .max_acceleration = max_acceleration_, .period = period_.duration()});
  if (!made) return component::refused(made.error());
  brake_ = std::move(made.value());
  return component::accepted();
}

/// At rest the noise of a single sample would be driven with until it has died away.
void Controller::take_over() {
  constexpr double kLearning = 0.05;  // of the time of the hand-over: the first few samples
  hand_over_.reset();
  lately_.reset();
  has_successors_ = std::ranges::any_of(
      face(act_).readers(), [](const auto* reader) { return reader->writers().size() > 1; });
  const std::vector<double>* const present = act_.taken_over();
  takes_over_ = present != nullptr;
  if (!takes_over_) return;
  const Controller* const other = predecessor();
  sampled_ = other != nullptr && other->sampled_;
  const auto rested = other == nullptr ? std::span<const double>() : other->lately_.get();
  takes_over_ = hand_over_.begin(*present, rested.empty() ? 0.0 : kLearning, rested);
}

/// Whoever wrote what is taken over; nullptr if that is no Controller.
const Controller* Controller::predecessor() const {
  for (const component::InputPortBase* const reader : face(act_).readers()) {
    for (const component::OutputPortBase* const writer : reader->writers()) {
      if (writer == &face(act_) || writer->current() != act_.taken_over()) continue;
      return dynamic_cast<const Controller*>(&writer->owner());
    }
  }
  return nullptr;
}

void Controller::sample_now() {
  if (std::exchange(sampled_, true)) samples_without_sensor_.assign(samples_without_sensor_ + 1);
}

/// What is no number is a fault of whoever measured it, at any time.
void Controller::count_without_sample(const std::vector<double>& measured) {
  if (sensor_without_sample_ == 0) {
    log_warning(
        "a value of `sensor` came without a Sample: nothing is computed (attribute "
        "sensor_without_sample counts them)");
  }
  sensor_without_sample_.assign(sensor_without_sample_ + 1);
  const bool finite =
      std::ranges::all_of(measured, [](double number) { return std::isfinite(number); });
  if (!finite) fault("sensor has a number that is not finite, expected finite numbers");
}

const std::vector<double>* Controller::reference_now(const std::vector<double>& measured) {
  const std::vector<double>* const reference = choose_reference(measured);
  rests_ = has_successors_ && reference != nullptr && all_rest(*reference, measured);
  return reference;
}

bool Controller::all_rest(const std::vector<double>& reference,
                          const std::vector<double>& measured) const {
  constexpr double kRest = 0.2;  // [rad/s], more than a count of an encoder makes
  const double most = kRest * period_;
  const auto joints = static_cast<std::size_t>(joints_.get());
  for (std::size_t i = joints; i < 2 * joints; ++i) {
    if (reference[i] != 0.0 || !(std::abs(measured[i]) <= most)) return false;
  }
  return true;
}

const std::vector<double>* Controller::choose_reference(const std::vector<double>& measured) {
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
  begin_to_brake(reference.value, measured);
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
    know_motion(measured);
    begin_to_brake(motion_, measured);
  }
}

void Controller::know_motion(const std::vector<double>& measured) {
  const auto joints = static_cast<std::size_t>(joints_.get());
  for (std::size_t i = 0; i < joints; ++i) {
    motion_[i] = measured[i];
    motion_[joints + i] = measured[joints + i] / period_.seconds();
  }
}

/// What was desired last may have been absurd: joints are not driven to where that would rest.
void Controller::begin_to_brake(const std::vector<double>& last,
                                const std::vector<double>& measured) {
  constexpr double kAbsurd = 0.5;  // [rad], far more than a controller that follows lags behind
  braking_ = true;
  brakings_.assign(brakings_ + 1);
  if (!std::exchange(late_, false)) brake_->begin(last);
  know_motion(measured);
  if (!brake_->rests_near(motion_, kAbsurd)) brake_->begin(motion_);
  log_warning(
      "the reference is older than declared: brakes, and holds until a reference rests where the "
      "joints are");
}

std::vector<DrivenJoint> Controller::joints_behind(const component::InputPortBase* input,
                                                   const component::Check& check) {
  return input == &face(reference_) ? acted_joints(check) : std::vector<DrivenJoint>{};
}

std::vector<DrivenJoint> Controller::driven_joints(const component::Check& check) const {
  std::vector<DrivenJoint> joints = acted_joints(check);
  answer_later(joints, samples_late(check), base::to_seconds(period()));
  return joints;
}

const std::vector<DrivenJoint>& Controller::acted_joints(const component::Check& check) const {
  static const std::vector<DrivenJoint> kUnknown;
  const std::vector<DrivenJoint>& joints = controllers::joints_behind(face(act_), check);
  return joints.size() == static_cast<std::size_t>(joints_.get()) ? joints : kUnknown;
}

void Controller::WeightCheck::check(component::Check& check) const {
  const auto gravity = controller_.gravity_held(check);
  for (const DrivenJoint& joint : controller_.driven_joints(check)) {
    const std::string wrong = objection_to_gravity(joint, gravity);
    if (!wrong.empty()) return check.error(wrong);
  }
}

}  // namespace armature::controllers
