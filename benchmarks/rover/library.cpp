// SPDX-License-Identifier: Apache-2.0
// The component library `rover_hardware`: the least that the rover's robot side needs for drives
// and for a camera. Wheels that answer and stand still, images that are grey: what is measured is
// the robot's process without its simulation.
#include <cstdint>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/registry.hpp"
#include "armature/controllers/base/limited_effort.hpp"
#include "robots/rover/wheel_sample.hpp"

namespace armature::benchmarks {
namespace {

/// The operations that RoverWheel calls.
class StandingDrives final : public component::Component {
 public:
  using Component::Component;

 private:
  rover::WheelSample read_wheel(int /*number*/) { return {.counts = 0, .fresh = true, .on = on_}; }
  bool set_wheel(int /*number*/, control::LimitedEffort /*effort*/) { return true; }
  bool wheel_on(int /*number*/, control::DrivePermit permit) { return on_ = bool(permit); }
  bool wheel_off(int /*number*/) {
    on_ = false;
    return true;
  }

  component::Operation<rover::WheelSample(int)> read_wheel_{
      this,
      "readWheel",
      component::serve<&StandingDrives::read_wheel>,
      "what a wheel's drive says",
      component::args("number"),
      component::in_own_thread};
  component::Operation<bool(int, control::LimitedEffort)> set_wheel_{
      this,
      "setWheel",
      component::serve<&StandingDrives::set_wheel>,
      "takes the voltage of a wheel's motor",
      component::args("number", "effort [V]"),
      component::in_own_thread};
  component::Operation<bool(int, control::DrivePermit)> wheel_on_{
      this,
      "wheelOn",
      component::serve<&StandingDrives::wheel_on>,
      "switches the drives on",
      component::args("number", "permit"),
      component::in_own_thread};
  component::Operation<bool(int)> wheel_off_{this,
                                             "wheelOff",
                                             component::serve<&StandingDrives::wheel_off>,
                                             "switches the drives off",
                                             component::args("number"),
                                             component::in_own_thread,
                                             component::in_any_state};

  bool on_ = false;
};

/// Images that differ from one to the next, as those of a camera do.
class GreyCamera final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_configure() override {
    picture_.assign(kWidth * kHeight * 3, kGrey);
    image_.set_sample(picture_);
    return component::accepted();
  }
  void on_update() override {
    picture_.front() = static_cast<std::uint8_t>(kGrey + ++images_ % 2);
    image_.write(picture_);
  }

  static constexpr std::size_t kWidth = 320;
  static constexpr std::size_t kHeight = 240;
  static constexpr std::uint8_t kGrey = 128;

  component::OutputPort<std::vector<std::uint8_t>> image_{
      this, "Image", "red, green, blue of each pixel, row 0 on top"};

  unsigned images_ = 0;
  std::vector<std::uint8_t> picture_;
};

}  // namespace
}  // namespace armature::benchmarks

ARMATURE_COMPONENT_LIBRARY(rover_hardware, registry) {
  using armature::component::Granularity;
  registry.add<armature::benchmarks::StandingDrives>(
      "StandingDrives", "the drives of a rover's wheels, which stand still", Granularity::kAtomic);
  registry.add<armature::benchmarks::GreyCamera>("GreyCamera", "a camera before a grey wall",
                                                 Granularity::kAtomic);
}
