// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "armature/component/author.hpp"
#include "armature/controllers/base/limited_effort.hpp"
#include "robots/rover/plant.hpp"
#include "robots/rover/wheel_sample.hpp"

namespace armature::rover {

ARMATURE_STRUCT(Place, (x, "m", "to the front of where the rover began"),
                (y, "m", "to the left of it"), (heading, "rad", "from x to y"));

/// The simulated rover in its arena (MODEL.md), in simulated or real time, as the application is
/// run. The components RoverWheel reach their drives by its operations; a Camera sees by `Place`.
///
/// Time passes for it when it is read or driven, and at each Sample. What breaks in it is set by
/// properties, for tests of faults.
/// @rt nonblocking, no allocation; some ten microseconds for each millisecond that passes
class SimulatedRover final : public component::Component {
 public:
  using Component::Component;

  /// @thread the component's own, or any while it does not run
  Plant& plant() { return *plant_; }

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override;
  void on_cleanup() override { plant_.reset(); }

  void let_time_pass();
  WheelSample read_wheel(int number);
  bool set_wheel(int number, control::LimitedEffort effort);
  bool wheel_on(int number, control::DrivePermit permit);
  bool wheel_off(int number);
  void put(double x, double y, double heading);
  std::optional<std::size_t> index_of(int number) const;

  component::Property<int> wheels_{
      this, "Wheels", 2, "2, with a caster, or 4", "", component::range(2, 4)};
  component::Property<int> silent_encoder_{
      this,
      "SilentEncoder",
      0,
      "number of the wheel whose encoder does not answer; 0: none",
      "",
      component::range(0, 4),
      component::changeable_while_running};
  component::Property<int> dead_motor_{this,
                                       "DeadMotor",
                                       0,
                                       "number of the wheel whose motor's winding is open; 0: none",
                                       "",
                                       component::range(0, 4),
                                       component::changeable_while_running};

  component::EventHandler<> sample_{this,
                                    "Sample",
                                    component::serve<&SimulatedRover::let_time_pass>,
                                    "time passes for it",
                                    component::optional,
                                    component::leads_to("Place")};
  component::OutputPort<Place> place_{this, "Place", "where the rover really is"};
  component::Operation<WheelSample(int)> read_wheel_{this,
                                                     "readWheel",
                                                     component::serve<&SimulatedRover::read_wheel>,
                                                     "what a wheel's drive says",
                                                     component::args("number"),
                                                     component::in_own_thread};
  component::Operation<bool(int, control::LimitedEffort)> set_wheel_{
      this,
      "setWheel",
      component::serve<&SimulatedRover::set_wheel>,
      "the voltage of a wheel's motor, for 100 ms",
      component::args("number", "effort [V]"),
      component::in_own_thread};
  component::Operation<bool(int, control::DrivePermit)> wheel_on_{
      this,
      "wheelOn",
      component::serve<&SimulatedRover::wheel_on>,
      "switches a wheel's drive on",
      component::args("number", "permit"),
      component::in_own_thread};
  component::Operation<bool(int)> wheel_off_{
      this,
      "wheelOff",
      component::serve<&SimulatedRover::wheel_off>,
      "switches a wheel's drive off: its motor brakes itself",
      component::args("number"),
      component::in_own_thread,
      component::in_any_state};
  component::Operation<void(double, double, double)> put_{
      this,
      "put",
      component::serve<&SimulatedRover::put>,
      "a hand puts the rover somewhere, at rest",
      component::args("x [m]", "y [m]", "heading [rad]"),
      component::in_own_thread};

  std::unique_ptr<Plant> plant_;
};

}  // namespace armature::rover
