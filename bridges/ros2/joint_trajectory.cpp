// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/joint_trajectory.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/face.hpp"
#include "armature/component/interface.hpp"
#include "armature/control/per_joint.hpp"
#include "bridges/ros2/internal/dds.hpp"
#include "bridges/ros2/internal/messages.hpp"
#include "bridges/ros2/internal/names.hpp"

namespace armature::ros2 {

using component::CommandStage;
using internal::Trajectory;

namespace {

/// Clocks of two machines differ by less.
constexpr std::int64_t kMostAhead_ns = 500'000'000;

Trajectory trajectory_of(const trajectory_msgs_msg_dds__JointTrajectory_& message) {
  Trajectory trajectory;
  trajectory.stamp_ns = internal::ns_of(message.header.stamp);
  for (const char* name : internal::elements_of(message.joint_names)) {
    trajectory.joints.emplace_back(name);
  }
  for (const auto& point : internal::elements_of(message.points)) {
    trajectory.points.push_back(
        {internal::elements_of(point.positions), internal::elements_of(point.velocities),
         internal::elements_of(point.accelerations), internal::elements_of(point.effort),
         internal::ns_of(point.time_from_start)});
  }
  return trajectory;
}

}  // namespace

void JointTrajectory::on_check(component::Check& check) const {
  Subscriber::on_check(check);
  const auto* const plays = check.target_of(play_path_);
  if (plays == nullptr) return;  // which is reported
  for (const component::OutputPortBase* const writer : check.writers_of(desired_)) {
    if (&writer->owner() == &plays->owner()) continue;
    check.error("nAxesDesiredPosition comes from '" + writer->owner().name() +
                    "', and the trajectories are played by '" + plays->owner().name() + "'",
                "connect " + plays->owner().name() + ".nAxesDesiredPosition");
  }
}

std::vector<JointTrajectory::Objection> JointTrajectory::objections(
    const Components& /*components*/) const {
  return internal::objections_to_names(names_, static_cast<std::size_t>(joints_.get()));
}

std::string JointTrajectory::open(const component::Surroundings& /*surroundings*/) {
  reader_ = reader(topic_, trajectory_msgs_msg_dds__JointTrajectory__desc, kCommands);
  limits_ = {names_, {}, {}, max_duration_};
  return ask_for_limits();
}

/// The generator's.
std::string JointTrajectory::ask_for_limits() {
  const auto* const plays = face(play_path_).target();
  if (plays == nullptr) return "no peer serves playPath: add an nAxesGeneratorTaught to its peers";
  for (const auto* property : component::interface_of(plays->owner()).properties) {
    std::vector<double>* const to = property->name() == "lower"   ? &limits_.lower
                                    : property->name() == "upper" ? &limits_.upper
                                                                  : nullptr;
    if (to == nullptr || !types::same_type(property->type(), types::type_of<Vector>())) continue;
    auto each = control::per_joint(property->name(), *static_cast<const Vector*>(property->data()),
                                   names_.get().size());
    if (!each) return each.error();
    *to = std::move(each).value();
  }
  if (!limits_.lower.empty() && !limits_.upper.empty()) return {};
  return "'" + plays->owner().name() + "' has no limits lower and upper";
}

void JointTrajectory::begin() {
  Subscriber::begin();
  motion_ = component::CommandHandle(component::CallStatus::kNotConnected);
  present_.reset();
  next_ = braking_ = rests_ = false;
}

void JointTrajectory::work() {
  receive(*reader_, [this](const void* sample) {
    return obey(
        trajectory_of(*static_cast<const trajectory_msgs_msg_dds__JointTrajectory_*>(sample)));
  });
  if (is_deaf()) forget();
  look_at_silence();
  look_whether_it_rests();
  look_at_motion();
  moves_.write(moves());
  progress_.write(moves() ? motion_.progress() : 1.0);
}

std::string JointTrajectory::obey(Trajectory trajectory) {
  if (std::string why = objection_to(trajectory); !why.empty()) return why;
  if (present_ == trajectory) return {};
  if (trajectory.points.empty()) trajectory.stamp_ns = stamp_of_stop(trajectory);
  present_ = std::move(trajectory);
  next_ = !present_->points.empty();
  brake();
  return {};
}

std::int64_t JointTrajectory::now_ns() const { return internal::ns_of(node().stamp_of(time())); }

/// It may be stamped by another clock. What was sent before it, or before the last motion, stays
/// refused; what is sent after it does not.
std::int64_t JointTrajectory::stamp_of_stop(const Trajectory& stop) const {
  return std::max(std::min(stop.stamp_ns, now_ns()), present_ ? present_->stamp_ns : 0);
}

std::string JointTrajectory::objection_to(const Trajectory& trajectory) const {
  if (trajectory.points.empty()) return {};  // a stop
  if (present_ && trajectory.stamp_ns != 0 && trajectory.stamp_ns < present_->stamp_ns) {
    return "its stamp is before that of the one before";
  }
  const std::int64_t ahead_ns = trajectory.stamp_ns - now_ns();
  if (ahead_ns > kMostAhead_ns) {
    return "its stamp is " + std::to_string(1e-9 * static_cast<double>(ahead_ns)) +
           " s ahead of the clock, and it would begin now: " +
           (is_simulated() ? "stamp it by /clock (use_sim_time), or with 0"
                           : "send it when its time has come, or stamp it with 0");
  }
  return internal::objection_to(trajectory, limits_);
}

void JointTrajectory::look_at_silence() {
  if (!is_silent()) return;
  if (moves() && !braking_) {
    log_warning("nobody has sent a trajectory for {} s: the motion brakes", max_silence_.get());
  }
  forget();
}

/// Nothing of what was sent goes on, or begins.
void JointTrajectory::forget() {
  present_.reset();
  next_ = false;
  brake();
}

/// On the path.
void JointTrajectory::brake() {
  if (!moves() || braking_) return;
  braking_ = true;
  motion_.cancel();
}

void JointTrajectory::look_at_motion() {
  if (moves()) return;
  if (motion_.sent()) {
    const CommandStage stage = motion_.stage();
    if (stage == CommandStage::kRefused) {
      refuse(motion_.reason());
    } else if (stage != CommandStage::kDone && !braking_) {
      log_warning("the motion ended: {}", motion_.reason());
    }
    // Its commander sends it still, and did not see why it ended.
    if (stage != CommandStage::kDone && !braking_) deafen();
    motion_ = component::CommandHandle(component::CallStatus::kNotConnected);
    braking_ = false;
  }
  if (is_deaf()) forget();
  if (!next_ || !rests_) return;
  next_ = false;
  play_next();
}

void JointTrajectory::look_whether_it_rests() {
  const auto desired = desired_.read();
  if (!desired.is_new()) return;
  rests_ = desired.value == last_desired_;
  last_desired_ = desired.value;
}

void JointTrajectory::play_next() {
  const auto path =
      internal::smooth_path_of(internal::way_of(*present_, limits_, last_desired_), limits_);
  if (!path || path.value().largest_deviation > max_deviation_) {
    deafen();
    return refuse(path ? "its corners are sharper than max_deviation allows: give velocities"
                       : path.error());
  }
  motion_ = play_path_.send(path.value().points, 1.0);
  if (motion_.sent()) return;
  deafen();
  refuse("it cannot be played: " + std::string(component::name_of(motion_.send_status())));
}

}  // namespace armature::ros2
