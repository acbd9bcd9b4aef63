// SPDX-License-Identifier: Apache-2.0
// usage: janus_io_cycle JANUS_FOLDER LIBRARY_FOLDER
//
// How long a cycle of the Janus head takes, as its deployment has it and as a hand-written loop, on
// the same simulated bus, for both ways to read the cards. Prints JSON, which `armature report`
// shows if it is io.json in the folder of the runs.
//
// A cycle begins with the Sample event and ends when the last motor frame has been on the wire. Its
// time is that on the bus, which is simulated and so exact, and that of the computation, which was
// measured: all that the application did in the period, its generator and arming included, or all
// that the loop did, without what the simulation of the robot took.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "armature/control/pid.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "robots/janus/aic/aic_driver.hpp"
#include "robots/janus/simulated_janus.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration kPeriod = 10ms;
constexpr std::size_t kCycles = 1500;  ///< 15 s: the motion and a rest
constexpr double kRadPerCount = 6.283185307179586 / kCountsPerTurn / 100.0;

/// One cycle of whoever it was.
struct Cycle {
  base::Time begin{};
  double computing_us = 0.0;
  std::array<double, kJoints> desired{};  ///< [rad]
};

struct Times {
  double bus_us = 0.0;
  std::array<double, kJoints> sensing_us{};  ///< of it until each joint's report has come
  double actuation_us = 0.0;                 ///< of it behind the last report
  double computing_us = 0.0;
  double cycle_us = 0.0;
  double wire_us = 0.0;
};

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

/// All frames that were on the wire.
class Wire {
 public:
  explicit Wire(can::VirtualBus& bus) {
    events_.reserve(kCycles * 10);
    bus.set_tap([this](const can::WireEvent& event) { events_.push_back(event); });
  }

  Times times_of(const std::vector<Cycle>& cycles) const {
    std::vector<Times> each;
    auto event = events_.begin();
    for (const Cycle& cycle : cycles) each.push_back(times_of(cycle, event));
    const auto median_of = [&](auto of) {
      std::vector<double> values;
      for (const Times& times : each) values.push_back(of(times));
      return median(std::move(values));
    };
    Times all{.bus_us = median_of([](const Times& one) { return one.bus_us; }),
              .actuation_us = median_of([](const Times& one) { return one.actuation_us; }),
              .computing_us = median_of([](const Times& one) { return one.computing_us; }),
              .cycle_us = median_of([](const Times& one) { return one.cycle_us; }),
              .wire_us = median_of([](const Times& one) { return one.wire_us; })};
    for (std::size_t i = 0; i < kJoints; ++i) {
      all.sensing_us[i] = median_of([i](const Times& one) { return one.sensing_us[i]; });
    }
    return all;
  }

 private:
  /// Heartbeats are no part of a cycle; they may be in its way, which the median does not see.
  /// @param event  the first that is not known to be before the cycle; then the first behind it
  Times times_of(const Cycle& cycle, std::vector<can::WireEvent>::const_iterator& event) const {
    Times times;
    base::Time end = cycle.begin;
    base::Time sensed = cycle.begin;
    while (event != events_.end() && event->begin < cycle.begin) ++event;
    for (; event != events_.end() && event->begin < cycle.begin + kPeriod; ++event) {
      const auto address = address_of(event->frame);
      if (!address || address->function == AicFunction::kHeartbeat) continue;
      times.wire_us += in_us(event->end - event->begin);
      end = event->end;
      if (address->function != AicFunction::kSensor) continue;
      times.sensing_us.at(static_cast<std::size_t>(address->number - 1)) = in_us(end - sensed);
      sensed = end;
    }
    times.actuation_us = in_us(end - sensed);
    times.bus_us = in_us(end - cycle.begin);
    times.computing_us = cycle.computing_us;
    times.cycle_us = times.bus_us + cycle.computing_us;
    return times;
  }

  std::vector<can::WireEvent> events_;
};

/// Measures what a piece of work took beside the simulation of the robot.
template <typename Work>
double computing_us(SimulatedLink& link, Work work) {
  const std::uint64_t spent = link.ticks_spent();
  const std::uint64_t begin = platform::ticks();
  work();
  const std::uint64_t all = platform::ticks() - begin;
  const std::uint64_t own = all - (link.ticks_spent() - spent);
  return static_cast<double>(own) * platform::tick_period_ns() * 1e-3;
}

/// The deployment pid.yaml while it moves.
class Deployed {
 public:
  Deployed(const std::string& janus, const std::string& libraries, const std::string& mode) {
    deploy::DeploymentOptions options;
    options.library_folders = {libraries};
    options.document.overrides = {"mode=" + mode};
    deployment_ = deploy::load_deployment(janus + "/deployments/pid.yaml", options);
    check(deployment_.diagnostics);
    deployment_.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment_.blueprint), deployment_.options);
    check(application_->start());
    application_->run_for(100ms);
    must(application_->call("Arming", "arm", {}));
    application_->run_for(1s);
    must(application_->call(
        "Generator", "moveTo",
        {types::Value::of(std::vector<double>{1.0, 1.0}), types::Value::of(10.0)}));
  }

  std::vector<Cycle> run() {
    std::vector<Cycle> cycles;
    for (std::size_t k = 0; k < kCycles; ++k) {
      Cycle cycle;
      cycle.computing_us = computing_us(cards().link(), [this] { application_->run_for(kPeriod); });
      cycle.begin = application_->now();
      cycle.desired = {desired("PID1"), desired("PID2")};
      cycles.push_back(cycle);
    }
    application_->run_for(kPeriod);  // the last motor frames
    return cycles;
  }

  SimulatedJanus& cards() { return *static_cast<SimulatedJanus*>(application_->find("Cards")); }

 private:
  static void check(const base::Diagnostics& diagnostics) {
    if (!diagnostics.ok()) throw std::runtime_error(diagnostics.to_text());
  }
  double desired(const char* pid) {
    return *must(application_->value_of(pid, "Ref")).get_if<double>();
  }

  deploy::Deployment deployment_;
  std::unique_ptr<exec::Application> application_;
};

/// The same by hand: reads the cards, computes, drives the motors. Written for this head alone.
class Loop {
 public:
  Loop(const std::string& janus, AicMode mode)
      : link_(must(SimulatedLink::make({.urdf_file = janus + "/janus.urdf"},
                                       SimulatedLink::Time::kSimulated, base::Time{}))),
        config_{.cards = {1, 2}, .mode = mode},
        driver_(open(*link_, config_)) {
    driver_.start(link_->now());
    link_->begin_cycle(kBegin - kPeriod);
    for (std::size_t i = 0; i < kJoints; ++i) {
      driver_.command(i, AicCommand::kActuatorOff);  // acknowledges what the watchdog did meanwhile
      driver_.command(i, AicCommand::kActuatorOn);
    }
    driver_.command(1, AicCommand::kBrakeRelease);
  }

  /// @param wanted  what the deployment wanted in its cycles
  std::vector<Cycle> run(const std::vector<Cycle>& wanted) {
    std::vector<Cycle> cycles;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      Cycle cycle{.begin = kBegin + static_cast<std::int64_t>(k) * kPeriod,
                  .desired = wanted[k].desired};
      cycle.computing_us = computing_us(*link_, [&] { step(cycle.begin, cycle.desired); });
      cycles.push_back(cycle);
    }
    link_->begin_cycle(cycles.back().begin + kPeriod);
    return cycles;
  }

  can::VirtualBus& bus() { return link_->simulation().bus(); }
  double position(std::size_t joint) const {
    return static_cast<double>(driver_.card(joint).counts) * kRadPerCount;
  }

 private:
  static constexpr base::Time kBegin = base::Time{} + 200ms;

  static AicDriver open(SimulatedLink& link, const AicDriver::Config& config) {
    base::Diagnostics diagnostics;
    if (!link.open(AicDriver::bus_options(config), diagnostics)) {
      throw std::runtime_error(diagnostics.to_text());
    }
    return must(AicDriver::make(link.bus(), config));
  }

  void step(base::Time now, const std::array<double, kJoints>& desired) {
    link_->begin_cycle(now);
    driver_.begin_reading(link_->now());
    while (driver_.poll(link_->now()) == AicReading::kWaiting) {
      link_->wait_for_news(driver_.deadline());
    }
    for (std::size_t i = 0; i < kJoints; ++i) {
      driver_.set_motor(i, pids_[i].step(desired[i] - position(i)) / kSupplyVoltage);
    }
    driver_.send_motors();
  }

  static control::Pid make_pid() {
    return must(control::Pid::make({.kp = 400, .ki = 20, .kd = 100, .u_min = -12, .u_max = 12}));
  }

  std::unique_ptr<SimulatedLink> link_;
  AicDriver::Config config_;
  AicDriver driver_;
  std::array<control::Pid, kJoints> pids_{make_pid(), make_pid()};
};

nlohmann::ordered_json measure(const std::string& janus, const std::string& libraries,
                               const std::string& mode) {
  Deployed deployed(janus, libraries, mode);
  const Wire wire(deployed.cards().simulation().bus());
  const std::vector<Cycle> cycles = deployed.run();
  const Times ours = wire.times_of(cycles);

  Loop loop(janus, mode == "sequential" ? AicMode::kSequential : AicMode::kSynchronous);
  const Wire its_wire(loop.bus());
  const Times its = its_wire.times_of(loop.run(cycles));
  const double off = std::abs(loop.position(0) - cycles.back().desired[0]);
  if (off > 0.01) throw std::runtime_error("the loop does not follow: " + std::to_string(off));

  return {{"cycle_us", ours.cycle_us},
          {"bus_us", ours.bus_us},
          {"computing_us", ours.computing_us},
          {"wire_us", ours.wire_us},
          {"joint1_sensing_us", ours.sensing_us[0]},
          {"joint2_sensing_us", ours.sensing_us[1]},
          {"actuation_us", ours.actuation_us},
          {"monolithic_cycle_us", its.cycle_us},
          {"monolithic_bus_us", its.bus_us},
          {"monolithic_computing_us", its.computing_us},
          {"cycles", cycles.size()}};
}

}  // namespace
}  // namespace armature::janus

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: janus_io_cycle JANUS_FOLDER LIBRARY_FOLDER\n";
    return 2;
  }
  try {
    nlohmann::ordered_json all{
        {"doc",
         "From the Sample event to the end of the last motor frame: the simulated time on the bus "
         "and the measured time of computing, the median of 1500 cycles; the hand-written loop "
         "does "
         "the same on the same bus, without components."}};
    for (const char* mode : {"sequential", "synchronous"}) {
      all[mode] = armature::janus::measure(argv[1], argv[2], mode);
    }
    std::cout << all.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "janus_io_cycle: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
