// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/controllers/base/axis_units.hpp"
#include "bridges/ros2/endpoint.hpp"
#include "bridges/ros2/internal/trajectory.hpp"

namespace armature::ros2 {

/// Moves the robot as trajectory_msgs/JointTrajectory says: the generator among its peers, an
/// nAxesGeneratorTaught, plays the whole path within its limits, from the place where it has the
/// joints. Where the trajectory is faster than these limits, it is slower on the same path.
///
/// It arms nothing: on a robot that is not armed a trajectory is refused. Refused as a whole are
/// also unknown, double or missing joints, another number of positions, numbers that are not
/// finite, times that do not rise, efforts, stamps that go backwards, and whatever leaves the
/// generator's limits. So is a trajectory that is stamped more than half a second ahead of the
/// clock: it is to begin later, and here each begins when it comes.
///
/// Who commands says so again and again: the same trajectory renews itself. After `max_silence`
/// without one the motion brakes on its path, and holds. A new one ends the one before in the same
/// way, and begins from there; one without points only brakes, whatever its stamp. At the
/// operator's stop it brakes, too. Where a motion ended for another reason, or was refused, who is
/// there is not heard any more: nothing goes on by itself.
class JointTrajectory final : public Subscriber {
 public:
  using Subscriber::Subscriber;

 private:
  using Vector = std::vector<double>;

  void on_check(component::Check& check) const override;
  bool moves_robots() const override { return true; }
  std::vector<Objection> objections(const Components& components) const override;
  std::string open(const component::Surroundings& surroundings) override;
  void close() override { reader_.reset(); }
  void begin() override;
  void work() override;
  void end() override { brake(); }

  std::string obey(internal::Trajectory trajectory);
  std::string ask_for_limits();
  std::string objection_to(const internal::Trajectory& trajectory) const;
  std::int64_t now_ns() const;
  std::int64_t stamp_of_stop(const internal::Trajectory& stop) const;
  void look_at_motion();
  void look_at_silence();
  void forget();
  void brake();
  void look_whether_it_rests();
  void play_next();
  bool moves() const { return motion_.sent() && !motion_.ended(); }

  controllers::AxisUnits units_{this, controllers::AxisUnit::Of::kAxes};
  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 1000)};
  component::Property<std::vector<std::string>> names_{
      this, "joint_names", {}, "in the order of the generator's axes", "", component::mandatory};
  component::Property<std::string> topic_{this, "topic", "joint_trajectory", "that it reads"};
  component::Property<double> max_duration_{this, "max_duration",
                                            60.0, "of a trajectory; the generator's is as long",
                                            "s",  component::range(0.1, 3600.0)};
  component::Property<double> max_deviation_{
      this,
      "max_deviation",
      0.02,
      "of the smooth path that is played from the trajectory; more is refused",
      "",
      component::range(1e-6, 1.0),
      component::unit_of(units_.position())};
  component::InputPort<Vector> desired_{
      this,
      "nAxesDesiredPosition",
      "where the generator has the joints",
      "",
      component::size_of(joints_),
      component::max_age(std::chrono::milliseconds(100), component::Reaction::kHold),
      component::on_lost(component::Reaction::kHold),
      component::unit_of(units_.position())};
  component::OutputPort<bool> moves_{this, "Moves", "a trajectory is played"};
  component::OutputPort<double> progress_{this, "Progress", "of that, 0..1"};
  component::CommandCaller<const Vector&, double> play_path_{this, "playPath", "plays a path"};

  std::unique_ptr<Reader> reader_;
  internal::TrajectoryLimits limits_;
  component::CommandHandle motion_{component::CallStatus::kNotConnected};
  std::optional<internal::Trajectory> present_;  ///< that was obeyed last
  bool next_ = false;                            ///< `present_` begins when the one before rests
  bool braking_ = false;                         ///< by this component
  Vector last_desired_;
  bool rests_ = false;  ///< the generator has the joints at rest
};

}  // namespace armature::ros2
