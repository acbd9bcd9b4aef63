// SPDX-License-Identifier: Apache-2.0
// The host of drives on CAN, and its frames.
#pragma once

#include <string_view>

namespace armature::cli {

inline constexpr std::string_view kProtocol =
    R"(// The frames of the drives: change them into those of yours.
//
// 0x200 + node, to a drive, once a cycle: [power, 0, 0, 0, torque in mNm as int32]
// 0x180 + node, its answer:               [power, 0, 0, 0, position in 10 urad as int32]
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "@name@_host.hpp"
#include "armature/can/frame.hpp"

namespace @name@ {

constexpr std::uint32_t kCommandId = 0x200;
constexpr std::uint32_t kAnswerId = 0x180;
constexpr std::uint32_t kNodeMask = 0x07f;
constexpr double kTorqueUnit = 1e-3;    // Nm
constexpr double kPositionUnit = 1e-5;  // rad

inline armature::can::Frame frame_of(std::uint32_t id, Power power, double number) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const double bounded = std::fmax(-kMost, std::fmin(kMost, std::round(number)));
  const auto word = static_cast<std::uint32_t>(static_cast<std::int32_t>(bounded));
  const auto byte = [word](int shift) { return static_cast<std::uint8_t>(word >> shift); };
  return armature::can::data_frame(
      id, {static_cast<std::uint8_t>(power), 0, 0, 0, byte(0), byte(8), byte(16), byte(24)});
}

inline double number_in(const armature::can::Frame& frame) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{frame.data[4 + i]} << (8 * i);
  return static_cast<double>(static_cast<std::int32_t>(word));
}

inline armature::can::Frame command_frame(std::uint32_t node, Power power, double torque) {
  return frame_of(kCommandId + node, power, torque / kTorqueUnit);
}
inline armature::can::Frame answer_frame(std::uint32_t node, Power power, double position) {
  return frame_of(kAnswerId + node, power, position / kPositionUnit);
}

/// The drive that a frame is for or from; 0 if it is none of `kind` or says nothing that is known.
inline std::uint32_t node_of(const armature::can::Frame& frame, std::uint32_t kind) {
  const bool known = !frame.extended && frame.kind == armature::can::FrameKind::kData &&
                     frame.size == 8 && (frame.id & ~kNodeMask) == kind &&
                     frame.data[0] <= static_cast<std::uint8_t>(Power::kFree);
  return known ? frame.id & kNodeMask : 0;
}

}  // namespace @name@
)";

inline constexpr std::string_view kCanHost = R"(#pragma once

#include <memory>
#include <string>
#include <vector>

#include "@name@_host.hpp"
#include "@name@_simulated_link.hpp"
#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/controllers/base/guarded_bus.hpp"
#include "armature/controllers/base/sampling_period.hpp"

namespace @name@ {

/// The drives on a CAN bus. The first one that is read in a cycle begins it: what came is taken, and
/// each drive is told its torque, which it answers. So an answer to a sample acts two cycles later.
class CanHost : public @Name@Host {
 public:
  using @Name@Host::@Name@Host;

 protected:
  virtual armature::base::Result<std::unique_ptr<armature::can::Link>> make_link() = 0;
  virtual Outcome begin_to_guard() { return accepted(); }
  /// False if the host is out of service.
  virtual bool is_guarded() { return true; }
  virtual void rest() {}
  virtual void end_guard() {}

  const std::vector<int>& nodes() const { return nodes_; }
  armature::base::Duration cycle() const { return period_.duration(); }
  void make_all_safe();

  Outcome on_configure() override;
  Outcome on_start() override;
  void on_stop() override;
  void on_cleanup() override;

 private:
  struct Drive {
    std::uint32_t node = 0;
    Power wanted = Power::kOff;
    double torque = 0.0;
    @Name@Sample said{};
  };

  @Name@Sample read(int node) override;
  bool set_torque(int node, LimitedEffort torque) override;
  bool set_power(int node, Power power) override;

  void begin_cycle();
  void keep_cycle();
  void take_answers();
  void tell_drives();
  void pass_time(armature::base::Duration time);
  Drive* find(std::uint32_t node);

  Property<std::vector<int>> nodes_{this, "nodes", {}, "of the drives, 1 to 127", "", mandatory};
  armature::controllers::SamplingPeriod period_{this};
  EventHandler<> sample_{this,
                         "Sample",
                         serve<&CanHost::keep_cycle>,
                         "keeps the cycle when no drive is read any more",
                         optional,
                         leads_to_nothing()};
  std::unique_ptr<armature::can::Link> link_;
  std::vector<Drive> drives_;
  armature::base::Time cycle_at_ = armature::base::Time::min();
};

/// On a CAN interface of this machine. A guardian switches the drives off if this process cannot.
class @Name@Bus final : public CanHost {
 public:
  using CanHost::CanHost;

 private:
  void on_check(Check& check) const override {
    if (!armature::can::is_virtual(bus_.get())) check.drives_hardware(bus_.get());
  }
  armature::base::Result<std::unique_ptr<armature::can::Link>> make_link() override {
    return std::unique_ptr<armature::can::Link>(
        std::make_unique<armature::can::BusLink>(bus_.get(), kBitRate));
  }
  Outcome begin_to_guard() override;
  bool is_guarded() override;
  void rest() override { guard_.rest(); }
  void end_guard() override { guard_.end(); }

  static constexpr std::uint32_t kBitRate = 1'000'000;

  Property<std::string> bus_{this, "bus", "can0", "the CAN interface"};
  armature::controllers::GuardedBus guard_{this};
};

/// Simulated drives on a simulated bus.
class Simulated@Name@Bus final : public CanHost {
 public:
  using CanHost::CanHost;

 private:
  armature::base::Result<std::unique_ptr<armature::can::Link>> make_link() override;

  Property<std::string> file_{this, "robot_description", "", "the URDF of the arm", "", mandatory};
  Property<std::vector<double>> start_{this, "start", {}, "where each joint begins", "rad", mandatory};
  Property<double> rotor_inertia_{this, "rotor_inertia", 0.0, "of each motor, at its joint", "kg m^2"};
};

}  // namespace @name@
)";

inline constexpr std::string_view kCanHostSource = R"(#include "@name@_can_host.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "@name@_protocol.hpp"
#include "armature/base/as_reason.hpp"

namespace @name@ {

namespace can = armature::can;

Outcome CanHost::on_configure() {
  if (Outcome outcome = period_.known(); !outcome) return outcome;
  drives_.clear();
  for (const int node : nodes_.get()) {
    if (node < 1 || node > 127 || find(static_cast<std::uint32_t>(node)) != nullptr) {
      return refused("nodes has " + std::to_string(node) + ", expected each of 1 to 127 once");
    }
    drives_.push_back({.node = static_cast<std::uint32_t>(node)});
  }
  auto link = make_link();
  if (!link) return refused(link.error());
  link_ = std::move(link).value();
  armature::base::Diagnostics diagnostics;
  if (!link_->open({}, diagnostics)) return refused(armature::base::as_reason(diagnostics));
  tell_drives();
  pass_time(std::chrono::milliseconds(20));
  take_answers();
  for (const Drive& drive : drives_) {
    if (drive.said.fresh) continue;
    return refused("drive " + std::to_string(drive.node) + " does not answer: look at its power, cable and node");
  }
  return begin_to_guard();
}

Outcome CanHost::on_start() {
  cycle_at_ = armature::base::Time::min();
  for (Drive& drive : drives_) {
    drive.wanted = Power::kOff;
    drive.torque = 0.0;
  }
  tell_drives();
  pass_time(cycle());
  link_->begin_run(time());
  return accepted();
}

void CanHost::on_stop() { make_all_safe(); }

void CanHost::on_cleanup() {
  end_guard();
  link_.reset();
}

void CanHost::make_all_safe() {
  for (Drive& drive : drives_) {
    drive.wanted = Power::kOff;
    drive.torque = 0.0;
  }
  tell_drives();
  rest();
}

// --- the cycle, in real time ----------------------------------------------------------------------

void CanHost::begin_cycle() {
  cycle_at_ = time();
  link_->begin_cycle(time());
  take_answers();
  tell_drives();
}

/// Drives whose components have ended hear that they are to be off.
void CanHost::keep_cycle() {
  const bool was_read =
      cycle_at_ != armature::base::Time::min() && time() < cycle_at_ + 3 * cycle() / 2;
  if (!was_read && is_guarded()) begin_cycle();
}

void CanHost::take_answers() {
  can::Arrival arrival;
  while (link_->bus().receive(arrival) == can::ReceiveStatus::kReceived) {
    Drive* const drive = find(node_of(arrival.frame, kAnswerId));
    if (drive == nullptr) continue;
    drive->said = {.fresh = true,
                   .power = arrival.frame.data[0],
                   .position = number_in(arrival.frame) * kPositionUnit};
  }
}

void CanHost::tell_drives() {
  for (const Drive& drive : drives_) {
    link_->bus().send(command_frame(drive.node, drive.wanted, drive.torque));
  }
}

void CanHost::pass_time(armature::base::Duration time) {
  const armature::base::Time until = link_->now() + time;
  while (link_->now() < until) link_->wait_for_news(until);
}

CanHost::Drive* CanHost::find(std::uint32_t node) {
  const auto found = std::find_if(drives_.begin(), drives_.end(),
                                  [node](const Drive& each) { return each.node == node; });
  return found == drives_.end() ? nullptr : &*found;
}

@Name@Sample CanHost::read(int node) {
  Drive* const drive = find(static_cast<std::uint32_t>(node));
  if (drive == nullptr || state() != State::kRunning) return {};
  if (cycle_at_ != time()) {
    if (!is_guarded()) return {};
    begin_cycle();
  }
  const @Name@Sample sample = drive->said;
  drive->said.fresh = false;
  return sample;
}

bool CanHost::set_torque(int node, LimitedEffort torque) {
  Drive* const drive = find(static_cast<std::uint32_t>(node));
  if (drive == nullptr) return false;
  drive->torque = torque;
  return true;
}

bool CanHost::set_power(int node, Power power) {
  Drive* const drive = find(static_cast<std::uint32_t>(node));
  if (drive == nullptr || (power != Power::kOff && state() != State::kRunning)) return false;
  drive->wanted = power;
  return true;
}

// --- the two buses --------------------------------------------------------------------------------

/// Nothing of it may move a joint: off, and 0 Nm.
Outcome @Name@Bus::begin_to_guard() {
  if (is_simulated()) return accepted();
  armature::guardian::Orders orders;
  orders.bus = bus_.get();
  orders.bit_rate = kBitRate;
  orders.period = cycle();
  for (std::size_t device = 0; device < nodes().size(); ++device) {
    const auto node = static_cast<std::uint32_t>(nodes()[device]);
    orders.safe.push_back(command_frame(node, Power::kOff, 0.0));
    orders.questions.push_back(orders.safe.back());
    orders.answers.push_back(
        {.device = device, .frame = answer_frame(node, Power::kOff, 0.0), .mask = {0xff}});
  }
  orders.answers_filter = {.id = kAnswerId, .mask = 0x780};
  const Outcome outcome = guard_.start(orders);
  if (outcome && !guard_.said().empty()) log_info("{}", guard_.said());
  return outcome;
}

bool @Name@Bus::is_guarded() {
  if (const auto reason = guard_.beat(time())) {
    make_all_safe();
    fault(reason->view());
    return false;
  }
  if (guard_.take_loss()) log_error("its guardian has died: nobody stops the drives if this process dies");
  return true;
}

armature::base::Result<std::unique_ptr<can::Link>> Simulated@Name@Bus::make_link() {
  auto arm = @Name@Plant::load(file_, start_, rotor_inertia_);
  if (!arm) return armature::base::Error{arm.error()};
  return std::unique_ptr<can::Link>(
      std::make_unique<SimulatedLink>(std::move(arm).value(), is_simulated(), time()));
}

}  // namespace @name@
)";

}  // namespace armature::cli
