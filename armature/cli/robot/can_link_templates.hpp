// SPDX-License-Identifier: Apache-2.0
// Simulated drives behind a simulated CAN bus.
#pragma once

#include <string_view>

namespace armature::cli {

inline constexpr std::string_view kSimulatedLink = R"(#pragma once

#include "@name@_plant.hpp"
#include "armature/can/link.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/can/virtual_station.hpp"

namespace @name@ {

/// Simulated drives, with nodes from 1 on, on a bus in this process. Time passes whenever the host
/// looks: that of the application, or with it the clock.
class SimulatedLink final : public armature::can::Link {
 public:
  SimulatedLink(@Name@Plant arm, bool simulated_time, armature::base::Time now);

  armature::can::Bus& bus() override { return host_; }
  bool open(armature::can::BusOptions options, armature::base::Diagnostics& diagnostics) override;
  void begin_run(armature::base::Time time) override;
  void begin_cycle(armature::base::Time time) override;
  armature::base::Time now() override { return now_; }
  void wait_for_news(armature::base::Time deadline) override;

 private:
  void advance_to(armature::base::Time now);
  void answer(const armature::can::Frame& command);

  @Name@Plant arm_;
  const bool simulated_time_;
  armature::base::Time now_;
  armature::base::Duration ahead_{};  ///< of the application, by what was waited before its run
  armature::can::VirtualBus bus_{"@name@", 1'000'000, [this] { return now_; }};
  armature::can::VirtualStation& host_ = bus_.add_station("host");
  armature::can::VirtualStation& drives_ = bus_.add_station("drives");
};

}  // namespace @name@
)";

inline constexpr std::string_view kSimulatedLinkSource = R"(#include "@name@_simulated_link.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "@name@_protocol.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace @name@ {

namespace can = armature::can;
using armature::base::Duration;
using armature::base::Time;

namespace {

/// In which drives see what came; about a frame.
constexpr Duration kStep = std::chrono::microseconds(100);

}  // namespace

SimulatedLink::SimulatedLink(@Name@Plant arm, bool simulated_time, Time now)
    : arm_(std::move(arm)),
      simulated_time_(simulated_time),
      now_(simulated_time ? now : armature::platform::monotonic_now()) {}

bool SimulatedLink::open(can::BusOptions options, armature::base::Diagnostics& diagnostics) {
  bus_.advance_to(now_);
  return host_.open(options, diagnostics) && drives_.open({}, diagnostics);
}

void SimulatedLink::begin_run(Time time) {
  if (simulated_time_) ahead_ = now_ - time;
  begin_cycle(time);
}

void SimulatedLink::begin_cycle(Time time) {
  advance_to(simulated_time_ ? time + ahead_ : armature::platform::monotonic_now());
}

void SimulatedLink::wait_for_news(Time deadline) {
  const Time next = std::min(deadline, now_ + kStep);
  if (!simulated_time_) {
    const armature::rt::PermitScope waiting;
    armature::platform::sleep_until(next);
  }
  advance_to(next);
}

void SimulatedLink::advance_to(Time now) {
  while (now_ < now) {
    const Time next = std::min(now, now_ + kStep);
    arm_.step(next - now_);
    now_ = next;
    bus_.advance_to(now_);
    can::Arrival arrival;
    while (drives_.receive(arrival) == can::ReceiveStatus::kReceived) answer(arrival.frame);
  }
}

void SimulatedLink::answer(const can::Frame& command) {
  const std::uint32_t node = node_of(command, kCommandId);
  if (node < 1 || node > arm_.joints()) return;
  const std::size_t joint = node - 1;
  arm_.set_power(joint, static_cast<Power>(command.data[0]));
  arm_.set_torque(joint, number_in(command) * kTorqueUnit);
  drives_.send(answer_frame(node, arm_.power(joint), arm_.position(joint)));
}

}  // namespace @name@
)";

}  // namespace armature::cli
