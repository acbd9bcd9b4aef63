// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/axes_generator/axes_check.hpp"
#include "armature/controllers/base/axis_units.hpp"
#include "armature/controllers/base/max_age.hpp"

namespace armature::controllers {

/// What generators of motions for N axes have in common: limits, what is measured and desired, and
/// whether the robot is armed. To be extended by how the axes move.
/// @thread the component's own
class GeneratorOfAxes : public component::Component {
 public:
  using Component::Component;

 protected:
  using Vector = std::vector<double>;
  static constexpr std::string_view kNotArmed = "the robot is not armed: arm first";

  /// Rests at `measured` from now on.
  /// @return the first axis of which it is no finite number, if there is one
  virtual std::optional<std::size_t> hold_at(const Vector& measured) = 0;
  /// Desired := measured, at rest; all commands end.
  virtual void settle() = 0;
  /// Brakes smoothly, and holds where it comes to rest; all commands end.
  virtual void stop() = 0;

  /// A run begins.
  void begin_run();
  /// Memory for as many axes.
  void resize(std::size_t axes) { numbers_.assign(axes, 0.0); }
  /// From the first value that was measured since the start.
  bool knows_position();
  /// Where nobody arms, everything may move. An Arming that lives elsewhere is believed its events.
  bool may_move();
  /// Out of service, as this axis was not measured.
  void refuse_measured(std::size_t axis);
  void write_desired(std::span<const double> positions, std::span<const double> velocities,
                     std::span<const double> accelerations);
  /// How far the motion under way is, for scripts and tools.
  void tell_progress(double progress, double remaining_s) {
    progress_.assign(progress);
    remaining_.assign(remaining_s);
  }
  /// The number of `axis`, where there may be one for all.
  static double limit_of(const Vector& numbers, std::size_t axis) {
    return numbers.size() == 1 ? numbers.front() : numbers[axis];
  }

  AxisUnits units_{this, AxisUnit::Of::kAxes};
  component::Property<int> axes_{
      this, "num_axes", 1, "number of axes", "", component::mandatory, component::range(1, 100000)};
  component::Property<Vector> max_velocity_{this,
                                            "max_vel",
                                            {},
                                            "largest velocity of each axis, > 0",
                                            "",
                                            component::mandatory,
                                            component::unit_of(units_.velocity())};
  component::Property<Vector> max_acceleration_{this,
                                                "max_acc",
                                                {},
                                                "largest acceleration of each axis, > 0",
                                                "",
                                                component::mandatory,
                                                component::unit_of(units_.acceleration())};
  component::Property<Vector> lower_{this,
                                     "lower",
                                     {},
                                     "smallest position of each axis",
                                     "",
                                     component::mandatory,
                                     component::unit_of(units_.position())};
  component::Property<Vector> upper_{this,
                                     "upper",
                                     {},
                                     "largest position of each axis",
                                     "",
                                     component::mandatory,
                                     component::unit_of(units_.position())};
  component::InputPort<Vector> measured_{this,
                                         "nAxesSensorPosition",
                                         "measured position of each axis",
                                         "",
                                         component::size_of(axes_),
                                         component::max_age(kMaxAge),
                                         component::unit_of(units_.position())};
  component::OperationCaller<bool()> is_armed_{this, "isArmed", "whether motions may begin",
                                               component::optional};
  component::OperationCaller<double(const Vector&, const Vector&)> limit_used_{
      this, "motionLimitUsed", "the share that positions and velocities use of a limit",
      component::optional};
  base::Time started_{};     ///< its run
  base::Time stepped_at_{};  ///< when the axes moved last

 private:
  void on_arm() { armed_ = true; }
  void on_disarm() {
    armed_ = false;
    settle();
  }

  component::Attribute<double> progress_{this, "progress", 1.0,
                                         "of the motion under way, 0..1; 1 if there is none"};
  component::Attribute<double> remaining_{this, "remaining_time", 0.0, "until the axes arrive [s]"};
  component::OutputPort<Vector> position_{
      this, "nAxesDesiredPosition",    "desired position of each axis",
      "",   component::size_of(axes_), component::unit_of(units_.position())};
  component::OutputPort<Vector> velocity_{
      this, "nAxesDesiredVelocity",    "desired velocity of each axis",
      "",   component::size_of(axes_), component::unit_of(units_.velocity())};
  component::OutputPort<Vector> acceleration_{
      this, "nAxesDesiredAcceleration", "desired acceleration of each axis",
      "",   component::size_of(axes_),  component::unit_of(units_.acceleration())};
  component::EventHandler<> settle_{this,
                                    "Settle",
                                    component::serve<&GeneratorOfAxes::settle>,
                                    "desired := measured, at rest",
                                    component::optional,
                                    component::leads_to_nothing()};
  component::EventHandler<> disarm_{this,
                                    "Disarm",
                                    component::serve<&GeneratorOfAxes::on_disarm>,
                                    "desired := measured, at rest; all motion ends",
                                    component::optional,
                                    component::leads_to_nothing()};
  component::EventHandler<> arm_{this,
                                 "Arm",
                                 component::serve<&GeneratorOfAxes::on_arm>,
                                 "motions may begin",
                                 component::optional,
                                 component::leads_to_nothing()};
  component::EventHandler<> stop_{this,
                                  "Stop",
                                  component::serve<&GeneratorOfAxes::stop>,
                                  "brakes smoothly, and holds where it comes to rest",
                                  component::optional,
                                  component::leads_to_nothing()};
  AxesCheck check_{this, axes_, {position_, lower_, upper_, max_velocity_, max_acceleration_}};
  bool position_known_ = false;
  bool armed_ = false;
  Vector numbers_;
};

}  // namespace armature::controllers
