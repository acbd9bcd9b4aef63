// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "armature/component/author.hpp"
#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {

/// What the pucks tell of their own state, on ports of the hardware: temperatures and currents
/// (paper 3, section 4.1). One puck is asked for one number at a time, behind the torques of a
/// cycle, so a port is written when the last puck has told its number; a round in which a puck did
/// not tell its number writes nothing, and the port shows its age.
class PuckPorts {
 public:
  /// @param joints  of `owner`
  PuckPorts(component::Component* owner, const component::Property<int>& joints);

  /// @thread configuration only
  void set_up(std::size_t motors) { values_.assign(motors, 0.0); }
  /// Nothing is known. @rt nonblocking, no allocation, as all below
  void begin(WamDriver& driver, base::Time now);
  /// Asks, where the cycle has time left on the bus.
  /// @param cycle_end  when the next one begins
  void ask(WamDriver& driver, base::Time now, base::Time cycle_end);
  /// Writes what came.
  void tell(const WamDriver& driver);

 private:
  using Numbers = component::OutputPort<std::vector<double>>;

  void write(PuckReading reading, const PuckWatch& pucks);

  component::Property<double> period_;
  Numbers temperatures_;
  Numbers motor_temperatures_;
  Numbers currents_;
  component::Attribute<int> unanswered_;
  std::array<std::uint64_t, kPuckReadings> rounds_{};
  std::uint64_t missed_before_ = 0;
  std::vector<double> values_;
};

}  // namespace armature::wam
