// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/cia402_drive.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>

#include "armature/component/interface.hpp"
#include "armature/controllers/base/reason_text.hpp"
#include "drives/cia402/homing.hpp"

namespace armature::cia402 {

using component::CallStatus;
using component::Outcome;
using component::Reason;
using controllers::append_number;

namespace {

using namespace std::chrono_literals;

/// As long a drive may take to be as it was told; brakes and voltages take their time.
constexpr base::Duration kPatience = 1s;
/// Before it is switched on to home, it changes its mode.
constexpr base::Duration kHomingPatience = 3s;
/// Two in a row are lost now and then; a joint that is not measured stops by itself later.
constexpr int kMostSilent = 3;

template <typename Answer>
bool succeeds(const Answer& answer) {
  return answer.status == CallStatus::kDone && answer.value;
}

const char* text_of(int power) {
  return power < 0 ? "unknown" : to_text(static_cast<PowerState>(power));
}

}  // namespace

/// Host and joint have to mean the same.
void Cia402Drive::on_check(component::Check& check) const {
  if (!temperature_object_.get().empty() && !canopen::parse_address(temperature_object_.get())) {
    check.error("temperature is '" + temperature_object_.get() + "'",
                "write index and subindex of the object in hexadecimal digits: 0x2110:01");
  }
  const Cia402Host* host = nullptr;
  for (const component::Component* const peer : check.peers()) {
    if (const auto* found = dynamic_cast<const Cia402Host*>(peer)) host = found;
  }
  if (host == nullptr) {
    return check.error("none of its peers is the bus that the drive is on",
                       "add a component of the model Cia402Bus or EmulatedCia402Bus to its peers");
  }
  const auto& nodes = host->nodes();
  if (std::find(nodes.begin(), nodes.end(), node_.get()) == nodes.end()) {
    check.error(
        "node " + std::to_string(node_.get()) + " is not among the nodes of '" + host->name() + "'",
        "add it there, or set the node that the drive has");
  }
  check_homing(*host, check);
  const std::string_view wanted = controllers::names_of(command_of(mode_on(*host))).actuator;
  const std::string whose =
      mode_ == DriveMode::kBus ? "the mode of '" + host->name() + "'" : "its mode";
  for (const component::InputPortBase* const input : component::interface_of(*this).inputs) {
    if (!input->name().ends_with("Actuator") || input->name() == wanted) continue;
    if (check.writers_of(*input).empty()) continue;
    check.error("its input " + input->name() + " has a writer, and " + whose + " needs " +
                    std::string(wanted),
                "set the mode of the bus or of the drive, or use the kind of joint that fits it");
  }
}

/// What its host asks 0x6061 for, and what CiA 402 has.
void Cia402Drive::check_homing(const Cia402Host& host, component::Check& check) const {
  if (homing_method_ == 0) return;
  if (!host.asks_slowly()) {
    check.error("homing_method is given, and slow_period of '" + host.name() + "' is 0",
                "set it above 0: the drive is asked in which mode it is");
  }
  if (!host.has_heartbeat()) {
    check.error("homing_method is given, and host_heartbeat of '" + host.name() + "' is 0",
                "set it above 0: a drive that moves by itself has to stop when its host is gone");
  }
  if (homing_method_ < 0 || find_homing_method(static_cast<std::int8_t>(homing_method_.get()))) {
    return;
  }
  check.error(
      "homing_method is " + std::to_string(homing_method_.get()) + ", which CiA 402 does not have",
      "set a method that the drive's manual has, such as 17, 18, 33, 34 or 37");
}

bool Cia402Drive::is_on(const Cia402Host& host, const component::Check& check) const {
  const component::OperationBase* const serves = check.target_of(read_drive_);
  return serves != nullptr && &serves->owner() == &host;
}

void Cia402Drive::refine(DrivePlan& plan) const {
  plan.wish.name = name();
  if (mode_ == DriveMode::kTorque) plan.mode = CyclicMode::kTorque;
  if (mode_ == DriveMode::kVelocity) plan.mode = CyclicMode::kVelocity;
  if (mode_ == DriveMode::kPosition) plan.mode = CyclicMode::kPosition;
  plan.wish.mode = mode_of(plan.mode);
  if (vendor_ != 0) plan.wish.identity->vendor = static_cast<std::uint32_t>(vendor_.get());
  if (product_ != 0) plan.wish.identity->product = static_cast<std::uint32_t>(product_.get());
  if (!eds_.get().empty()) plan.eds_file = eds_;
  if (homing_method_ != 0) {
    plan.wish.homing = HomingWish{.method = static_cast<std::int8_t>(homing_method_.get()),
                                  .speed = homing_speed_,
                                  .slow_speed = homing_slow_speed_,
                                  .acceleration = homing_acceleration_,
                                  .offset = home_offset_};
  }
  plan.temperature = canopen::parse_address(temperature_object_.get());
  plan.temperature_scale = temperature_scale_;
  plan.temperature_offset = temperature_offset_;
}

CyclicMode Cia402Drive::mode_on(const Cia402Host& host) const {
  DrivePlan plan;
  plan.mode = host.mode();
  plan.expect(0, 0);
  refine(plan);
  return plan.mode;
}

Outcome Cia402Drive::on_start() {
  want(Wanted::kOff);
  return component::accepted();
}

// --- measuring -----------------------------------------------------------------------------------

bool Cia402Drive::sensor_read() {
  const auto answer = read_drive_(node_);
  if (answer.status != CallStatus::kDone) return false;
  show(answer.value);
  if (!usable(answer.value)) return false;
  if (answer.value.has_current) current_.write(answer.value.current);
  if (answer.value.has_temperature) temperature_.write(answer.value.temperature);
  velocity_.write(answer.value.velocity);
  effort_.write(answer.value.effort);
  sensor_.write(answer.value.position);
  return true;
}

void Cia402Drive::show(const DriveSample& sample) {
  power_.assign(sample.power);
  error_code_.assign(sample.error_code);
  const DriveStatus status = status_of(static_cast<std::uint16_t>(sample.status));
  warns_.assign(status.warning);
  limited_.assign(status.internal_limit);
  status_.write(status);
  homing_ = sample.homing;
  if (wanted_ == Wanted::kHome && homing_ == static_cast<int>(HomingStage::kAttained)) {
    homed_ = true;
  }
}

bool Cia402Drive::usable(const DriveSample& sample) {
  if (sample.no_bus) {
    fault("the bus of the drive is gone");
  } else if (sample.unprepared) {
    lose_position();
    homed_ = false;
    fault("the drive rebooted: call resetDrive of its bus, which prepares it again");
  } else if (sample.lost) {
    fault("the drive's heartbeat is missing: look at its power and its cable");
  } else if (sample.silent_cycles > kMostSilent) {
    Reason why("the drive did not answer for ");
    fault(append_number(why, sample.silent_cycles).append(" cycles: look at its cable"));
  } else if (sample.power == static_cast<int>(PowerState::kFault) ||
             sample.power == static_cast<int>(PowerState::kFaultReactionActive)) {
    Reason why("the drive failed with error code ");
    fault(append_number(why, sample.error_code)
              .append(": mend what its manual says of it, then call resetDrive of its bus"));
  } else if (!sample.obeys) {
    fault("the drive does not give the torque that it was told: look at its motor and its limits");
  } else if (sample.frozen) {
    fault(
        "the drive tells the same values in each cycle while it was told other torques: look at "
        "its sensor, and for what blocks it");
  } else if (!does_what_it_was_told(sample)) {
    Reason why(was_enabled_ ? "the drive switched off by itself: it is "
                            : "the drive does not switch on: it is ");
    fault(why.append(text_of(sample.power)));
  }
  return sample.fresh && state() == component::State::kRunning;
}

bool Cia402Drive::does_what_it_was_told(const DriveSample& sample) {
  const bool enabled = sample.power == static_cast<int>(PowerState::kOperationEnabled);
  const bool on = enabled || sample.power == static_cast<int>(PowerState::kSwitchedOn);
  if (wanted_ == Wanted::kOff) return true;
  const bool reached = wanted_ == Wanted::kSwitchedOn ? on : enabled;
  if (reached) was_enabled_ = true;
  const base::Duration patience = wanted_ == Wanted::kHome ? kHomingPatience : kPatience;
  return reached || (!was_enabled_ && time() - wanted_since_ < patience);
}

// --- driving -------------------------------------------------------------------------------------

bool Cia402Drive::actuator_on() {
  want(brake_ ? Wanted::kSwitchedOn : Wanted::kEnabled);
  return energize(!brake_);
}

/// A drive that stops quickly switches off by itself when it stands, and brakes then.
bool Cia402Drive::actuator_off() {
  const bool stops = power_() == static_cast<int>(PowerState::kOperationEnabled) ||
                     power_() == static_cast<int>(PowerState::kQuickStopActive);
  want(Wanted::kOff);
  return make_safe(stops);
}

bool Cia402Drive::brake_apply() {
  want(Wanted::kOff);
  return make_safe(true);
}

bool Cia402Drive::brake_release() {
  want(Wanted::kEnabled);
  return energize(true);
}

/// A drive that moves by itself to find home is not at home.
bool Cia402Drive::home(control::DrivePermit permit) {
  if (homing_method_ == 0 || !succeeds(home_drive_(node_, permit))) return false;
  homed_ = false;
  homing_ = static_cast<int>(HomingStage::kUnderWay);
  want(Wanted::kHome);
  return true;
}

void Cia402Drive::want(Wanted wanted) {
  wanted_ = wanted;
  wanted_since_ = time();
  was_enabled_ = false;
}

bool Cia402Drive::actuator_set(control::LimitedEffort effort) {
  return succeeds(set_effort_(node_, effort));
}

bool Cia402Drive::velocity_set(control::LimitedVelocity velocity) {
  return succeeds(set_velocity_(node_, velocity));
}

bool Cia402Drive::position_set(control::LimitedPosition position) {
  return succeeds(set_position_(node_, position));
}

bool Cia402Drive::energize(bool enable) {
  return succeeds(energize_drive_(node_, enable, permit()));
}

bool Cia402Drive::make_safe(bool quick_stop) {
  return succeeds(make_drive_safe_(node_, quick_stop));
}

}  // namespace armature::cia402
