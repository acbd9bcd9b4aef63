// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/node.hpp"

#include <algorithm>
#include <chrono>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"
#include "bridges/ros2/internal/dds_log.hpp"
#include "bridges/ros2/internal/own_thread.hpp"

namespace armature::ros2 {

constexpr base::Duration kClocksAreSet = std::chrono::seconds(1);
constexpr base::Duration kDdsIsTold = std::chrono::seconds(10);

void RosNode::on_check(component::Check& check) const {
  if (is_loopback(interface_.get())) return;
  check.warning("the interface '" + interface_.get() +
                    "' opens it to other machines, and DDS proves nobody's identity and encrypts "
                    "nothing: whoever is in that network may command what its topics command",
                "use the interface lo, or a network that only the robot's own machines are in");
}

std::vector<RosNode::Objection> RosNode::check_view(
    const std::vector<component::Component*>& components) const {
  for (const component::Component* each : components) {
    if (each == this) break;  // the one that comes later objects
    if (dynamic_cast<const RosNode*>(each) == nullptr) continue;
    return {{"'" + each->name() + "' is a RosNode, too, and an application is one node",
             "remove one of them"}};
  }
  return {};
}

void RosNode::observe(const component::Surroundings& surroundings) {
  refused_ = internal::objection_to_thread(*this, surroundings);
  set_clocks();
  if (const auto opened = participant(); !opened && refused_.empty()) refused_ = opened.error();
}

Network RosNode::network() const { return {node_, namespace_, domain_, interface_, peers_}; }

base::Result<std::shared_ptr<Participant>> RosNode::participant() {
  if (participant_ == nullptr) {
    auto opened = Participant::open(network());
    if (!opened) return opened;
    participant_ = std::move(opened).value();
  }
  return participant_;
}

component::Outcome RosNode::on_start() {
  if (!refused_.empty()) return component::refused(refused_);
  if (!is_loopback(interface_.get())) {
    log_warning("open to other machines on {}: DDS proves nobody's identity, encrypts nothing",
                interface_.get());
  }
  return component::accepted();
}

void RosNode::on_update() {
  if (time() - clocks_set_at_ >= kClocksAreSet) set_clocks();
  if (time() - told_at_ >= kDdsIsTold) tell_of_dds();
}

/// Once in a while, however much it is.
void RosNode::tell_of_dds() {
  told_at_ = time();
  const rt::PermitScope allocates;
  const internal::DdsLog log = internal::take_dds_log();
  if (log.lines > 0) log_warning("DDS had {} complaints, the last: {}", log.lines, log.last);
}

/// The wall clock is adjusted while an application runs.
void RosNode::set_clocks() {
  clocks_set_at_ = time();
  if (is_simulated()) return;
  const auto wall = std::chrono::system_clock::now().time_since_epoch();
  const auto offset = std::chrono::duration_cast<base::Duration>(wall) -
                      platform::monotonic_now().time_since_epoch();
  to_wall_clock_ns_.store(offset.count(), std::memory_order_relaxed);
}

Stamp RosNode::stamp_of(base::Time time) const {
  const std::int64_t ns = std::max<std::int64_t>(
      0, base::to_ns(time) + to_wall_clock_ns_.load(std::memory_order_relaxed));
  constexpr std::int64_t kSecond = 1'000'000'000;
  return {static_cast<std::int32_t>(ns / kSecond), static_cast<std::uint32_t>(ns % kSecond)};
}

}  // namespace armature::ros2
