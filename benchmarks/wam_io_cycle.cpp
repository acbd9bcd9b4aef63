// SPDX-License-Identifier: Apache-2.0
// usage: wam_io_cycle WAM_FOLDER LIBRARY_FOLDER
//
// How long a cycle of the WAM takes at 500 Hz on the emulated arm while it moves: as its
// deployments have it, with a PID for each joint and with computed torque, and by a hand-written
// loop without components, which does what the PIDs' deployment does at least: the driver, the
// arm's own joint controller and the compensation of its gravity. Prints JSON, which `armature
// report` shows if it is io.json in the folder of the runs.
//
// A cycle begins with the Sample event, or the loop's request of positions, and ends when the last
// torque frame has been on the wire. Its time is that on the bus, which is simulated and so exact,
// and that of the computation, which was measured: all that the application did in the period, its
// generator and arming included, or all that the loop did, without what the simulation of the arm
// took.
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

#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/platform/clock.hpp"
#include "benchmarks/wam_deployed_cycle.hpp"
#include "robots/wam/driver/wam_driver.hpp"
#include "robots/wam/driver/wam_startup.hpp"
#include "robots/wam/driver/wire_time.hpp"
#include "robots/wam/emulator/arm_motors.hpp"
#include "robots/wam/emulator/emulator.hpp"
#include "robots/wam/joint_controller.hpp"

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

/// The medians of cycles.
struct Times {
  double cycle_us = 0.0;
  double bus_us = 0.0;
  double computing_us = 0.0;
  double wire_us = 0.0;
};

Times times_of(const DeployedCycles& cycles) {
  std::vector<double> all, bus, frames;
  for (const CycleOnWire& cycle : cycles_on_wire(cycles.begins, cycles.wire, kCycleTime)) {
    bus.push_back(in_us(cycle.bus));
    frames.push_back(in_us(cycle.frames));
    all.push_back(bus.back() + cycles.computing_us[all.size()]);
  }
  return {median(all), median(bus), median(cycles.computing_us), median(frames)};
}

/// Home is at the stops of joints 2 and 4.
double target_of(const ArmNumbers& arm, std::size_t joint) {
  return arm.home[joint] + (joint == 3 ? -kFar : kFar);
}

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
      : arm_(arm),
        home_(arm.home),
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
    for (std::size_t i = 0; i < home_.size(); ++i) {
      reference[i] = home_[i] + (target_of(arm_, i) - home_[i]) * way;
    }
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
  const ArmNumbers& arm_;
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

  DeployedCycles run() {
    DeployedCycles cycles;
    cycles.wire.reserve(kCycles * 13);
    emulator_->bus().set_tap([&](const can::WireEvent& event) { cycles.wire.push_back(event); });
    for (std::size_t i = 0; i < kCycles; ++i) {
      cycles.begins.push_back(now());
      const double way = static_cast<double>(i) / kCycles;
      cycles.computing_us.push_back(step((1.0 - std::cos(3.141592653589793 * way)) / 2.0));
      check(i);
    }
    emulator_->bus().set_tap(nullptr);
    return cycles;
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

/// What the deployment `controller` needs.
nlohmann::ordered_json measure_deployed(const ArmNumbers& arm, const std::string& controller,
                                        const std::string& folder, const std::string& libraries) {
  std::vector<double> target;
  for (std::size_t i = 0; i < arm.joints(); ++i) target.push_back(target_of(arm, i));
  const std::string file =
      folder + "/deployments/" + controller + std::to_string(arm.joints()) + ".yaml";
  const Times times = times_of(run_deployed(file, libraries, target, kCycles, kCycleTime));
  const double think = in_us(Puck::Config{}.reply_delay);
  return {{"cycle_us", times.cycle_us},
          {"bus_us", times.bus_us},
          {"computing_us", times.computing_us},
          {"wire_us", times.wire_us},
          {"period_us", in_us(kCycleTime)},
          {"pucks_us", think},
          {"bus_of_wire", times.bus_us / times.wire_us},
          {"bus_without_pucks_of_wire", (times.bus_us - think) / times.wire_us},
          {"cycles", kCycles}};
}

/// The same, beside the hand-written loop.
nlohmann::ordered_json measure(const ArmNumbers& arm, const std::string& folder,
                               const std::string& libraries) {
  nlohmann::ordered_json measured = measure_deployed(arm, "npid", folder, libraries);
  const Times its = times_of(Loop(arm, folder).run());
  measured["monolithic_cycle_us"] = its.cycle_us;
  measured["monolithic_bus_us"] = its.bus_us;
  measured["monolithic_computing_us"] = its.computing_us;
  return measured;
}

}  // namespace
}  // namespace armature::wam

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: wam_io_cycle WAM_FOLDER LIBRARY_FOLDER\n";
    return 2;
  }
  using armature::wam::measure;
  using armature::wam::measure_deployed;
  using armature::wam::wam4;
  using armature::wam::wam7;
  try {
    nlohmann::ordered_json all{
        {"doc",
         "From the Sample event to the end of the last torque frame at 500 Hz: the simulated time "
         "on the bus and the measured time of computing, the median of 2500 cycles of a motion; "
         "the "
         "hand-written loop drives the arm without components. wire_us is the frames' own time, "
         "pucks_us what the pucks take to answer, which is assumed."}};
    all["wam7"] = measure(wam7(), argv[1], argv[2]);
    all["wam7_computed_torque"] = measure_deployed(wam7(), "computed_torque", argv[1], argv[2]);
    all["wam4"] = measure(wam4(), argv[1], argv[2]);
    all["wam4_computed_torque"] = measure_deployed(wam4(), "computed_torque", argv[1], argv[2]);
    std::cout << all.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "wam_io_cycle: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
