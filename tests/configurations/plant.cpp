// SPDX-License-Identifier: Apache-2.0
#include "tests/configurations/plant.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>
#include <utility>

#include "armature/component/interface.hpp"
#include "drives/cia402_components/emulated_cia402_bus.hpp"
#include "robots/janus/simulated_janus.hpp"
#include "robots/rover/numbers.hpp"
#include "robots/rover/simulated_rover.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::configurations {
namespace {

class JanusHead final : public Plant {
 public:
  explicit JanusHead(janus::SimulatedJanus& cards) : simulation_(cards.simulation()) {}

  void advance_to(base::Time now) override {
    if (simulation_.now() < now) simulation_.advance_to(now);
  }
  Vector positions() override {
    Vector all;
    for (std::size_t i = 0; i < janus::kJoints; ++i) {
      all.push_back(simulation_.head().position(i, simulation_.now()));
    }
    return all;
  }
  bool driven() override {
    return simulation_.card(0).state() == janus::AicState::kOn ||
           simulation_.card(1).state() == janus::AicState::kOn;
  }

 private:
  janus::Simulation& simulation_;
};

class WamArm final : public Plant {
 public:
  explicit WamArm(wam::EmulatedLink& link) : link_(link), emulator_(link.emulator()) {}

  void advance_to(base::Time now) override {
    // Its clock is ahead by what the conversation before the run took.
    const base::Time theirs = now + link_.ahead();
    if (emulator_.now() < theirs) emulator_.advance_to(theirs);
  }
  Vector positions() override {
    Vector all;
    for (std::size_t i = 0; i < emulator_.motors(); ++i) {
      all.push_back(link_.motors().arm().joint_position(i));
    }
    return all;
  }
  bool driven() override {
    for (std::size_t i = 0; i < emulator_.motors(); ++i) {
      const wam::Puck& puck = emulator_.puck(i);
      if (puck.state() == wam::PuckState::kReady && puck.mode() != wam::PuckMode::kIdle)
        return true;
    }
    return false;
  }
  bool press_estop() override {
    emulator_.board().estop();
    return true;
  }

 private:
  wam::EmulatedLink& link_;
  wam::Emulator& emulator_;
};

class RoverOnFloor final : public Plant {
 public:
  explicit RoverOnFloor(rover::Plant& plant) : plant_(plant) {}

  void advance_to(base::Time now) override { plant_.advance_to(now); }
  Vector positions() override {
    Vector ways;
    for (std::size_t i = 0; i < plant_.wheels(); ++i) {
      ways.push_back(rover::kWheelRadius * plant_.wheel_angle(i));
    }
    return ways;
  }
  bool driven() override {
    for (std::size_t i = 0; i < plant_.wheels(); ++i) {
      if (plant_.is_on(i)) return true;
    }
    return false;
  }

 private:
  rover::Plant& plant_;
};

/// The drives of examples/07_own_robot: what their encoders tell is where they are.
class Servos final : public Plant {
 public:
  explicit Servos(exec::Application& application) : application_(application) {}

  void add(component::Component& drive) {
    for (component::OutputPortBase* output : component::interface_of(drive).outputs) {
      if (output->name() != "DisplacementSensor") continue;
      drives_.push_back({drive.name(), output, output->current_time(), 0.0});
    }
  }
  void advance_to(base::Time /*now*/) override {
    for (Drive& drive : drives_) {
      const base::Time written = drive.displacement->current_time();
      if (written != std::exchange(drive.written, written))
        drive.angle += *static_cast<const double*>(drive.displacement->current());
    }
  }
  Vector positions() override {
    Vector all;
    for (const Drive& drive : drives_) all.push_back(kGearRatio * drive.angle);
    return all;
  }
  bool driven() override {
    return std::ranges::any_of(drives_, [this](const Drive& drive) {
      const auto on = application_.value_of(drive.name, "on");
      return on && *static_cast<const bool*>(on.value().data());
    });
  }

 private:
  static constexpr double kGearRatio = 0.01;
  struct Drive {
    std::string name;
    component::OutputPortBase* displacement;
    base::Time written;
    double angle;
  };
  exec::Application& application_;
  std::vector<Drive> drives_;
};

/// Drives by CiA 402, each with an axis of its own.
class Cia402Arm final : public Plant {
 public:
  /// @param now  of the application, whose clock theirs is ahead of by what the start took
  Cia402Arm(cia402::EmulatedBus& drives, base::Time now)
      : drives_(drives), ahead_(drives.bus().now() - now) {}

  void advance_to(base::Time now) override {
    const base::Time theirs = now + ahead_;
    while (drives_.bus().now() < theirs) {
      drives_.advance_to(std::min(theirs, drives_.bus().now() + kStep));
    }
  }
  Vector positions() override {
    Vector all;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      all.push_back(drives_.drive(i).axis().position());
    }
    return all;
  }
  bool driven() override {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
      const cia402::PowerState power = drives_.drive(i).power();
      if (power == cia402::PowerState::kOperationEnabled ||
          power == cia402::PowerState::kQuickStopActive ||
          power == cia402::PowerState::kFaultReactionActive) {
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr base::Duration kStep = std::chrono::microseconds(50);

  cia402::EmulatedBus& drives_;
  const base::Duration ahead_;
};

void erase_property(document::Component& component, std::string_view name) {
  std::erase_if(component.properties, [&](const auto& each) { return each.name == name; });
}

void set_property(document::Component& component, const std::string& name,
                  const std::string& text) {
  erase_property(component, name);
  document::Property property;
  property.name = name;
  property.value.kind = document::Value::Kind::kText;
  property.value.text = text;
  component.properties.push_back(std::move(property));
}

}  // namespace

std::optional<document::Document> simulated(document::Document document) {
  bool changed = false;
  for (document::Component& each : document.components) {
    const document::Property* const bus = document::find(each.properties, "bus");
    if (each.model == "WamHardware" && bus != nullptr && bus->value.text != "emulator") {
      set_property(each, "bus", "emulator");
      changed = true;
    }
    if (each.model == "Cia402Bus") {
      changed = true;
      each.model = "EmulatedCia402Bus";
      for (const char* of_the_bus : {"bus", "guardian"}) erase_property(each, of_the_bus);
    }
    if (each.model != "AICBus") continue;
    changed = true;
    each.model = "SimulatedJanus";
    for (const char* of_the_bus : {"bus", "bit_rate", "guardian"}) erase_property(each, of_the_bus);
    set_property(each, "robot_description", SOURCE "/robots/janus/janus.urdf");
  }
  return changed ? std::optional(std::move(document)) : std::nullopt;
}

std::vector<std::unique_ptr<Plant>> plants_of(const document::Document& document,
                                              exec::Application& application) {
  std::vector<std::unique_ptr<Plant>> plants;
  auto servos = std::make_unique<Servos>(application);
  for (const document::Component& each : document.components) {
    component::Component* const found = application.find(each.name);
    if (found == nullptr) continue;
    if (each.model == "SimulatedJanus") {
      plants.push_back(std::make_unique<JanusHead>(static_cast<janus::SimulatedJanus&>(*found)));
    } else if (each.model == "WamHardware") {
      wam::EmulatedLink* const link = static_cast<wam::WamHardware&>(*found).emulated();
      if (link != nullptr) plants.push_back(std::make_unique<WamArm>(*link));
    } else if (each.model == "SimulatedRover") {
      rover::Plant& plant = static_cast<rover::SimulatedRover&>(*found).plant();
      plants.push_back(std::make_unique<RoverOnFloor>(plant));
    } else if (each.model == "EmulatedCia402Bus") {
      cia402::EmulatedBus& drives = static_cast<cia402::EmulatedCia402Bus&>(*found).drives();
      plants.push_back(std::make_unique<Cia402Arm>(drives, application.now()));
    } else if (each.model == "Servo") {
      servos->add(*found);
    }
  }
  if (!servos->positions().empty()) plants.push_back(std::move(servos));
  return plants;
}

namespace {

std::vector<Shipped> wam_deployments(const std::string& joints) {
  const std::string folder = SOURCE "/robots/wam/deployments/";
  std::vector<Shipped> all;
  for (const char* name : {"npid", "controller_wam", "computed_torque", "gravity_pd", "modes"}) {
    all.push_back({folder + (name + joints) + ".yaml"});
  }
  all.push_back({folder + "npid" + joints + ".yaml", {"bus=can0"}});
  return all;
}

// Of wam7.urdf, and by how much a motion that is followed may be faster.
constexpr double kSpeedOfWam = 2.0 * 1.15;
constexpr double kSinkingOfWam = 1.3;  ///< as its campaign has it at most

}  // namespace

RobotUnderTest janus() {
  const std::string folder = SOURCE "/robots/janus/";
  return {.name = "janus",
          .deployments = {{folder + "deployments/pid.yaml"},
                          {folder + "deployments/pid_feed_forward.yaml"},
                          {folder + "deployments/modes.yaml"},
                          {folder + "deployments/paper2.yaml"},
                          {folder + "deployments/served.yaml"},
                          {folder + "deployments/on_can.yaml"},
                          {.file = folder + "deployments/operator.yaml", .has_robot = false},
                          {folder + "demo/pid.yaml"},
                          {folder + "demo/pid_feedforward.yaml"}},
          .most_speed = 3.4,  // of janus.urdf
          .lower = {-0.5, -0.5},
          .upper = {4.5, 4.5},
          .step = {0.5, 0.5},
          .sinking = 0.1};
}

RobotUnderTest wam4() {
  return {.name = "wam4",
          .deployments = wam_deployments("4"),
          .most_speed = kSpeedOfWam,
          .lower = {-2.6, -2.0, -2.8, -0.9},
          .upper = {2.6, 2.0, 2.8, 3.1416},
          .step = {0.3, 0.4, 0.3, -0.5},
          .sinking = kSinkingOfWam};
}

RobotUnderTest wam7() {
  RobotUnderTest robot = wam4();
  robot.name = "wam7";
  robot.deployments = wam_deployments("7");
  for (const char* name : {"npid", "computed_torque", "two_controllers", "weightless"}) {
    robot.deployments.push_back({SOURCE "/robots/wam/demo/" + std::string(name) + ".yaml"});
  }
  robot.lower = {-2.6, -2.0, -2.8, -0.9, -4.76, -1.6, -3.0};
  robot.upper = {2.6, 2.0, 2.8, 3.1416, 1.24, 1.6, 3.0};
  robot.step = {0.3, 0.4, 0.3, -0.5, 0.3, 0.3, 0.3};
  return robot;
}

RobotUnderTest own_robot() {
  const std::string folder = SOURCE "/examples/07_own_robot/";
  return {.name = "own",
          .deployments = {{folder + "arm.yaml"}, {folder + "recorded.yaml"}},
          .most_speed = 2.4,  // of a motor that has 12 V
          .lower = {-1.58, -1.58, -1.58},
          .upper = {1.58, 1.58, 1.58},
          .step = {0.3, -0.3, 0.3},
          .sinking = 0.1};
}

RobotUnderTest cia402_arm() {
  const std::string folder = SOURCE "/examples/12_cia402/";
  return {.name = "cia402",
          .deployments = {{folder + "position.yaml"},
                          {folder + "velocity.yaml"},
                          {folder + "torque.yaml"},
                          {folder + "on_can.yaml"}},
          .most_speed = 2.0 * 1.25,  // with what a drive overshoots
          .lower = {-1.5708, -1.5708},
          .upper = {1.5708, 1.5708},
          .step = {0.3, -0.3},
          .sinking = 0.1};
}

RobotUnderTest rover() {
  const std::string folder = SOURCE "/robots/rover/deployments/";
  return {.name = "rover",
          .deployments = {{folder + "by_script.yaml"},
                          {folder + "by_script.yaml", {"wheels=4"}},
                          {folder + "rover.yaml", {"Ball.Way=circle"}}},
          .most_speed = 0.6 * 1.25,  // [m/s] with what a wheel's controller overshoots
          .lower = {},
          .upper = {},
          .step = {0.4, 0.4},
          .sinking = 0.02,
          .braking = 1.0};
}

}  // namespace armature::configurations
