// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"
#include "drives/cia402/emulated_arm.hpp"
#include "drives/cia402/emulated_drive.hpp"

namespace armature::cia402 {

/// Emulated drives on a virtual bus, with nodes one after the other.
class EmulatedBus {
 public:
  struct Config {
    std::string name = "drives";
    std::uint32_t bit_rate = 1'000'000;
    std::size_t drives = 1;  ///< 1 to 127
    canopen::NodeId first_node = 1;
    EmulatedDrive::Config drive{};  ///< of all; its node is set here, its serial number, too
    std::shared_ptr<EmulatedArm>
        arm{};                     ///< that they move, with a joint for each; none: an axis each
    can::VirtualBus::Clock clock;  ///< the time that it is
    base::Time begin{};
  };

  /// An error says which node or factor cannot be.
  static base::Result<std::unique_ptr<EmulatedBus>> make(const Config& config);
  EmulatedBus(const EmulatedBus&) = delete;
  EmulatedBus& operator=(const EmulatedBus&) = delete;

  can::VirtualBus& bus() { return bus_; }
  std::size_t size() const { return drives_.size(); }
  EmulatedDrive& drive(std::size_t i) { return *drives_[i]; }
  /// By which drive `i` is on the bus, for what breaks there.
  can::VirtualStation& station(std::size_t i) { return *stations_[i]; }
  /// nullptr if there is none.
  EmulatedDrive* find(unsigned node);

  /// Frames and axes up to `now`.
  void advance_to(base::Time now);

 private:
  explicit EmulatedBus(const Config& config);
  void advance_arm_to(base::Time now);

  std::shared_ptr<EmulatedArm> arm_;
  base::Time arm_now_;
  can::VirtualBus bus_;
  std::vector<can::VirtualStation*> stations_;
  std::vector<std::unique_ptr<EmulatedDrive>> drives_;
};

}  // namespace armature::cia402
