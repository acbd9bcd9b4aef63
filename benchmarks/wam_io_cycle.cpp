// SPDX-License-Identifier: Apache-2.0
// usage: wam_io_cycle WAM_FOLDER
//
// How long a cycle of the WAM takes by a hand-written loop without components: the driver, the
// arm's own joint controller and the compensation of its gravity, at 500 Hz on the emulated arm
// while it moves. Prints JSON, with the names that janus_io_cycle has for its hand-written loop.
//
// A cycle begins with the request of positions and ends when the last torque frame has been on the
// wire. Its time is that on the bus, which is simulated and so exact, and that of the computation,
// which was measured, without what the simulation of the arm took.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "armature/control/inverse_dynamics.hpp"
#include "armature/platform/clock.hpp"
#include "robots/wam/arm_motors.hpp"
#include "robots/wam/emulator.hpp"
#include "robots/wam/joint_controller.hpp"
#include "robots/wam/wam_driver.hpp"
#include "robots/wam/wam_startup.hpp"
#include "robots/wam/wire_time.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration kCycleTime = 2ms;
constexpr std::size_t kCycles = 2500;  ///< 5 s: the whole motion
constexpr double kFar = 0.3;           ///< [rad] of each joint, from home into the range

template <typename T>
T must(base::Result<T> result) {
  if (!result) throw std::runtime_error(result.error());
  return std::move(result).value();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double in_us(base::Duration duration) { return static_cast<double>(duration.count()) * 1e-3; }

control::InverseDynamics load_dynamics(const std::string& file) {
  base::Diagnostics diagnostics;
  auto dynamics =
      control::InverseDynamics::load(file, {.gravity = {0.0, 0.0, -kGravity}}, diagnostics);
  if (!dynamics) throw std::runtime_error(diagnostics.to_text());
  return std::move(*dynamics);
}

/// From the measured motors to their torques.
class Controller {
 public:
  Controller(const ArmNumbers& arm, const std::string& urdf)
      : home_(arm.home),
        transmission_(must(control::Transmission::make(arm.transmission))),
        dynamics_(load_dynamics(urdf)),
        controller_(must(JointController::make({.gains = arm.gains}))),
        motors(arm.joints()),
        joints(arm.joints()),
        reference(arm.joints()),
        torques_(arm.joints()),
        gravity_(arm.joints()) {}

  /// @param way  from 0 at home to 1
  void step(double way) {
    for (std::size_t i = 0; i < home_.size(); ++i) reference[i] = reference_at(i, way);
    transmission_.joint_angles(motors, joints);
    controller_.step(reference, joints, torques_);
    if (!dynamics_.gravity(joints, gravity_)) throw std::runtime_error("no finite torques");
    for (std::size_t i = 0; i < torques_.size(); ++i) torques_[i] += gravity_[i];
    transmission_.motor_torques(torques_, motors);
  }
  void motors_at_home(std::vector<double>& angles) const {
    transmission_.motor_angles(home_, angles);
  }

 private:
  /// Home is at the stops of joints 2 and 4.
  double reference_at(std::size_t joint, double way) const {
    return home_[joint] + (joint == 3 ? -kFar : kFar) * way;
  }

  const std::vector<double>& home_;
  control::Transmission transmission_;
  control::InverseDynamics dynamics_;
  JointController controller_;

 public:
  std::vector<double> motors;  ///< angles before, torques after a step
  std::vector<double> joints;
  std::vector<double> reference;

 private:
  std::vector<double> torques_;
  std::vector<double> gravity_;
};

/// The emulated arm with its host, in simulated time.
class Loop {
 public:
  Loop(const ArmNumbers& arm, const std::string& folder)
      : urdf_(folder + "/" + std::string(arm.urdf)),
        motors_(must(ArmSimulation::load(arm, {.urdf_file = urdf_})), base::Time{}),
        emulator_(must(Emulator::make(Emulator::standard(arm.joints()), motors_))),
        host_(emulator_->bus().add_station("host")),
        controller_(arm, urdf_) {
    base::Diagnostics diagnostics;
    if (!host_.open(WamDriver::bus_options(), diagnostics)) {
      throw std::runtime_error(diagnostics.to_text());
    }
    start_up();
    driver_->start(now());
    for (int i = 0; i < 100; ++i) {
      step(0.0);
      if (i == 25) emulator_->board().shift_activate();
    }
    if (!driver_->active()) throw std::runtime_error("the arm is not active");
  }

  nlohmann::ordered_json measure() {
    std::vector<can::WireEvent> log;
    log.reserve(kCycles * 13);
    emulator_->bus().set_tap([&](const can::WireEvent& event) { log.push_back(event); });
    std::vector<base::Time> begins;
    std::vector<double> computing;
    for (std::size_t i = 0; i < kCycles; ++i) {
      begins.push_back(now());
      const double way = static_cast<double>(i) / kCycles;
      computing.push_back(step((1.0 - std::cos(3.141592653589793 * way)) / 2.0));
      check(i);
    }
    std::vector<double> bus;
    std::vector<double> frames;
    std::vector<double> cycles;
    for (const CycleOnWire& cycle : cycles_on_wire(begins, log, kCycleTime)) {
      bus.push_back(in_us(cycle.bus));
      frames.push_back(in_us(cycle.frames));
      cycles.push_back(bus.back() + computing[cycles.size()]);
    }
    const double think = in_us(Puck::Config{}.reply_delay);
    return {{"monolithic_cycle_us", median(cycles)},
            {"monolithic_bus_us", median(bus)},
            {"monolithic_computing_us", median(computing)},
            {"wire_us", median(frames)},
            {"period_us", in_us(kCycleTime)},
            {"pucks_us", think},
            {"bus_without_pucks_of_wire", (median(bus) - think) / median(frames)},
            {"cycles", kCycles}};
  }

 private:
  base::Time now() const { return emulator_->now(); }

  void start_up() {
    emulator_->board().reset();
    emulator_->board().shift_idle();
    emulator_->advance_to(now() + 400ms);
    WamStartup::Config config;
    config.motors = emulator_->motors();
    std::vector<double> home(config.motors);
    controller_.motors_at_home(home);
    std::copy(home.begin(), home.end(), config.home.begin());
    auto startup = must(WamStartup::make(host_, config));
    startup->connect(now());
    talk(*startup);
    startup->zero(now());
    talk(*startup);
    driver_.emplace(must(WamDriver::make(host_, startup->record(), {})));
  }
  void talk(WamStartup& startup) {
    while (startup.poll(now()) == WamProgress::kTalking) {
      emulator_->advance_to_next_event(startup.deadline());
    }
    if (startup.poll(now()) != WamProgress::kDone) {
      throw std::runtime_error(startup.diagnostics().to_text());
    }
  }

  /// @return what the computation took [us]
  double step(double way) {
    const base::Time next = now() + kCycleTime;
    const std::uint64_t begin = platform::ticks();
    std::uint64_t simulated = 0;
    driver_->begin_reading(now());
    while (driver_->poll(now()) == WamReading::kWaiting) {
      const std::uint64_t before = platform::ticks();
      emulator_->advance_to_next_event(driver_->deadline());
      simulated += platform::ticks() - before;
    }
    for (std::size_t i = 0; i < motors_.count(); ++i) {
      controller_.motors[i] = driver_->motor(i).position;
    }
    controller_.step(way);
    for (std::size_t i = 0; i < motors_.count(); ++i) {
      driver_->set_torque(i, controller_.motors[i], now());
    }
    driver_->send_torques(now());
    const std::uint64_t own = platform::ticks() - begin - simulated;
    emulator_->advance_to(next);
    return static_cast<double>(own) * platform::tick_period_ns() * 1e-3;
  }

  void check(std::size_t cycle) const {
    double off = 0.0;
    for (std::size_t i = 0; i < motors_.count(); ++i) {
      off = std::max(off, std::abs(controller_.joints[i] - controller_.reference[i]));
    }
    if (driver_->active() && off < 0.02) return;
    throw std::runtime_error("in cycle " + std::to_string(cycle) + " the arm is " +
                             std::to_string(off) + " rad off, fault: " + to_text(driver_->fault()));
  }

  std::string urdf_;
  ArmMotors motors_;
  std::unique_ptr<Emulator> emulator_;
  can::VirtualStation& host_;
  Controller controller_;
  std::optional<WamDriver> driver_;
};

}  // namespace
}  // namespace armature::wam

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: wam_io_cycle WAM_FOLDER\n";
    return 2;
  }
  try {
    nlohmann::ordered_json all{
        {"doc",
         "From the request of positions to the end of the last torque frame at 500 Hz: the "
         "simulated time on the bus and the measured time of computing, the median of 2500 cycles "
         "of a hand-written loop; wire_us is the frames' own time, pucks_us what the pucks take "
         "to answer."}};
    all["wam7"] = armature::wam::Loop(armature::wam::wam7(), argv[1]).measure();
    all["wam4"] = armature::wam::Loop(armature::wam::wam4(), argv[1]).measure();
    std::cout << all.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "wam_io_cycle: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
