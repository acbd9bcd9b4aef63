// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "armature/can/link.hpp"
#include "robots/janus/simulation.hpp"

namespace armature::janus {

/// The simulated robot in the host's own thread, which lets time pass there whenever it looks.
class SimulatedLink final : public can::Link {
 public:
  enum class Time {
    kSimulated,  ///< waiting takes no time: the simulation runs ahead of the application's clock
    kReal,       ///< on the monotonic clock
  };

  /// The robot is switched on now.
  /// @param now  on the application's clock, which is the simulation's, too
  static base::Result<std::unique_ptr<SimulatedLink>> make(const Head::Config& head, Time time,
                                                           base::Time now);

  can::Bus& bus() override { return *host_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_cycle(base::Time time) override;
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

  /// What this machine has spent on the simulation of the robot, which a host of a real robot
  /// would not have to: ticks of platform::ticks().
  std::uint64_t ticks_spent() const { return ticks_spent_; }
  Simulation& simulation() { return *simulation_; }
  can::VirtualStation& station() { return *host_; }

 private:
  explicit SimulatedLink(Time time) : time_(time) {}
  void advance_to(base::Time now);

  const Time time_;
  std::uint64_t ticks_spent_ = 0;
  std::unique_ptr<Simulation> simulation_;
  can::VirtualStation* host_ = nullptr;
};

}  // namespace armature::janus
