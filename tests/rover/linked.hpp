// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/remote/interface_file.hpp"
#include "robots/rover/ball.hpp"
#include "robots/rover/ball_path.hpp"
#include "robots/rover/following.hpp"
#include "tests/rover/rover.hpp"
#include "tests/rover/simulated_link.hpp"

namespace armature::rover {

/// The rover in one process or several, all in simulated time, whose networks have these delays.
class Linked {
 public:
  /// @param files  of deployments; the first one has the chassis
  explicit Linked(const std::vector<std::string>& files, const Delays& delays = {},
                  std::uint32_t seed = 1) {
    for (const std::string& file : files) add(file);
    for (auto& process : processes_) process->robot->start();
    for (auto& process : processes_) connect(*process, delays, seed);
    chassis().arm();
    for (std::size_t k = 1; k < processes_.size(); ++k) {
      exec::Application& other = processes_[k]->robot->application();
      other.run_for(chassis().application().now() - other.now());
    }
  }

  ~Linked() {
    for (auto& process : processes_) {
      for (Elsewhere* const each : process->elsewhere) each->disconnect();
    }
  }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  Robot& chassis() { return *processes_.front()->robot; }
  void go(BallWay way) {
    const auto done = chassis().application().call("Ball", "go", {types::Value::of(way)});
    ASSERT_TRUE(done) << done.error();
  }
  void run_for(base::Duration duration) {
    constexpr base::Duration kStep = std::chrono::milliseconds(1);
    for (base::Duration past{}; past < duration; past += kStep) {
      for (auto& process : processes_) process->robot->run_for(kStep);
      for (auto& process : processes_) {
        for (Elsewhere* const each : process->elsewhere) each->pass_time(kStep);
      }
    }
  }
  /// Where rover and ball really were, every 50 ms.
  std::vector<Sight> watch(base::Duration duration) {
    constexpr base::Duration kLook = std::chrono::milliseconds(50);
    std::vector<Sight> sights;
    for (base::Duration past{}; past < duration; past += kLook) {
      run_for(kLook);
      const Place place = chassis().plant().place();
      const auto ball = chassis().value<BallPoint>("Ball", "Point");
      Sight sight;
      sight.view = {place.x, place.y, place.heading, ball.x, ball.y, ball.z};
      sights.push_back(sight);
    }
    return sights;
  }
  /// What stands for the chassis in the pilot; the last process has it.
  Elsewhere& chassis_of_pilot() {
    return dynamic_cast<Elsewhere&>(*processes_.back()->robot->application().find("Chassis"));
  }
  template <typename T>
  T of_pilot(const char* component, const char* item) {
    return processes_.back()->robot->value<T>(component, item);
  }

 private:
  struct Process {
    std::unique_ptr<Robot> robot{};
    std::vector<Elsewhere*> elsewhere{};
    std::vector<std::string> originals{};
  };

  void add(const std::string& file) {
    Process& added = *processes_.emplace_back(std::make_unique<Process>());
    deploy::DeploymentOptions how;
    how.read_interface = remote::read_interface;
    how.make_placeholder = [&added](const document::Component& written,
                                    std::unique_ptr<component::Component> prototype) {
      const std::string& name = written.remote.name;
      added.originals.push_back(name.substr(name.rfind('/') + 1));
      auto made =
          std::make_unique<Elsewhere>(written.name, std::move(prototype), added.originals.back());
      added.elsewhere.push_back(made.get());
      return base::Result<std::unique_ptr<component::Component>>(std::move(made));
    };
    added.robot = std::make_unique<Robot>(std::string(ROVER "/deployments/") + file,
                                          std::vector<std::string>(), std::move(how));
  }
  void connect(Process& process, const Delays& delays, std::uint32_t& seed) {
    for (std::size_t k = 0; k < process.elsewhere.size(); ++k) {
      for (auto& other : processes_) {
        component::Component* const original =
            other->robot->application().find(process.originals[k]);
        if (original == nullptr || dynamic_cast<Elsewhere*>(original) != nullptr) continue;
        process.elsewhere[k]->connect(process.robot->application(), other->robot->application(),
                                      delays, seed += 2);
      }
    }
  }

  std::vector<std::unique_ptr<Process>> processes_;
};

}  // namespace armature::rover
