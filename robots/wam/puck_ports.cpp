// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/puck_ports.hpp"

#include <chrono>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::wam {
namespace {

constexpr double kZeroCelsius = 273.15;  // [K]
/// What is left of the torque frames, a question and its answer, with the puck's time to think.
constexpr base::Duration kOnTheBus = std::chrono::microseconds(500);

}  // namespace

PuckPorts::PuckPorts(component::Component* owner, const component::Property<int>& joints)
    : period_(owner, "puck_period", 0.05,
              "between two questions to pucks for temperatures and currents, two frames each; 0: "
              "none",
              "s", component::range(0.0, 60.0)),
      temperatures_(owner, "puckTemperaturePort",
                    "of each puck, as it told last: three times the pucks times puck_period for "
                    "all",
                    "K", component::size_of(joints)),
      motor_temperatures_(owner, "motorTemperaturePort", "of the motor of each puck, likewise", "K",
                          component::size_of(joints)),
      currents_(owner, "motorCurrentPort",
                "of the motor of each puck, likewise, in the puck's own units", "",
                component::size_of(joints)),
      unanswered_(owner, "unanswered_puck_questions", 0,
                  "since the start, for temperatures and currents") {}

void PuckPorts::begin(WamDriver& driver, base::Time now) {
  driver.watch_pucks(now, {.period = base::from_seconds(period_)});
  rounds_.fill(0);
  missed_before_ = driver.pucks().counters().missed;
  unanswered_.assign(0);
}

void PuckPorts::ask(WamDriver& driver, base::Time now, base::Time cycle_end) {
  if (now + kOnTheBus <= cycle_end) driver.ask_puck(now);
}

void PuckPorts::tell(const WamDriver& driver) {
  for (std::size_t i = 0; i < kPuckReadings; ++i) {
    const auto reading = static_cast<PuckReading>(i);
    const std::uint64_t rounds = driver.pucks().rounds(reading);
    if (std::exchange(rounds_[i], rounds) != rounds) write(reading, driver.pucks());
  }
  const auto missed = static_cast<int>(driver.pucks().counters().missed - missed_before_);
  if (missed != unanswered_()) unanswered_.assign(missed);
}

void PuckPorts::write(PuckReading reading, const PuckWatch& pucks) {
  const bool in_celsius = reading != PuckReading::kCurrent;
  for (std::size_t motor = 0; motor < values_.size(); ++motor) {
    values_[motor] = pucks.values(reading)[motor] + (in_celsius ? kZeroCelsius : 0.0);
  }
  Numbers& port = reading == PuckReading::kTemperature        ? temperatures_
                  : reading == PuckReading::kMotorTemperature ? motor_temperatures_
                                                              : currents_;
  port.write(values_);
}

}  // namespace armature::wam
