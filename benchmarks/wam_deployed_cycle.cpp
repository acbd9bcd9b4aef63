// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/wam_deployed_cycle.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "robots/wam/wam_hardware.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr double kFollows = 0.02;  ///< [rad]

void check(const base::Diagnostics& diagnostics) {
  if (!diagnostics.ok()) throw std::runtime_error(diagnostics.to_text());
}

class Deployed {
 public:
  Deployed(const std::string& file, const std::string& libraries) : file_(file) {
    deploy::DeploymentOptions options;
    options.library_folders = {libraries};
    auto deployment = deploy::load_deployment(file, options);
    check(deployment.diagnostics);
    deployment.options.simulated = true;
    application_ =
        std::make_unique<exec::Application>(std::move(deployment.blueprint), deployment.options);
    check(application_->start());
    application_->run_for(500ms);  // its operator activates it
    call("Arming", "arm", {});
    application_->run_for(1500ms);  // then its torques may grow as they like
  }

  void move_to(const std::vector<double>& target, base::Duration time) {
    call("Generator", "moveTo",
         {types::Value::of(target), types::Value::of(base::to_seconds(time))});
  }

  DeployedCycles run(std::size_t count, base::Duration period) {
    DeployedCycles cycles;
    cycles.wire.reserve(count * 13);
    auto& bus = link().emulator().bus();
    bus.set_tap([&](const can::WireEvent& event) { cycles.wire.push_back(event); });
    for (std::size_t i = 0; i < count; ++i) {
      cycles.computing_us.push_back(computing_us(period));
      cycles.begins.push_back(application_->now() + link().ahead());
    }
    bus.set_tap(nullptr);
    return cycles;
  }

  void check_arrived(const std::vector<double>& target) {
    application_->run_for(200ms);
    double off = 0.0;
    for (std::size_t i = 0; i < target.size(); ++i) {
      const double position = link().motors().arm().joint_position(i);
      off = std::max(off, std::abs(position - target[i]));
    }
    if (application_->faults() == 0 && application_->reactions() == 0 && off < kFollows) return;
    throw std::runtime_error(file_ + ": after the motion the arm is " + std::to_string(off) +
                             " rad off");
  }

 private:
  EmulatedLink& link() { return *static_cast<WamHardware*>(application_->find("WAM"))->emulated(); }
  void call(const char* component, const char* operation, std::vector<types::Value> arguments) {
    const auto answer = application_->call(component, operation, std::move(arguments));
    if (!answer) throw std::runtime_error(answer.error());
  }
  /// Of one period, beside the simulation of arm and bus.
  double computing_us(base::Duration period) {
    const std::uint64_t spent = link().ticks_spent();
    const std::uint64_t begin = platform::ticks();
    application_->run_for(period);
    const std::uint64_t all = platform::ticks() - begin;
    const std::uint64_t own = all - (link().ticks_spent() - spent);
    return static_cast<double>(own) * platform::tick_period_ns() * 1e-3;
  }

  std::string file_;
  std::unique_ptr<exec::Application> application_;
};

}  // namespace

DeployedCycles run_deployed(const std::string& deployment, const std::string& libraries,
                            const std::vector<double>& target, std::size_t cycles,
                            base::Duration period) {
  Deployed deployed(deployment, libraries);
  deployed.move_to(target, static_cast<std::int64_t>(cycles) * period);
  DeployedCycles made = deployed.run(cycles, period);
  deployed.check_arrived(target);
  return made;
}

}  // namespace armature::wam
