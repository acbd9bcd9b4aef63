// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::janus {

/// What connects the virtual bus of a plant with hosts in other processes. One thread takes,
/// advances the bus, gives, and waits.
class PlantWire {
 public:
  PlantWire() = default;
  PlantWire(const PlantWire&) = delete;
  PlantWire& operator=(const PlantWire&) = delete;
  virtual ~PlantWire() = default;

  /// What hosts have sent goes to the virtual bus; never waits.
  virtual void take() = 0;
  /// What came for them on the virtual bus goes to the hosts; never waits.
  virtual void give() = 0;
  /// Waits until hosts may have sent something, or until `deadline`.
  virtual void wait_until(base::Time deadline) = 0;
};

/// Hosts connect to a socket file; nullptr after an error.
std::unique_ptr<PlantWire> make_shared_wire(can::VirtualBus& bus, const std::string& path,
                                            base::Diagnostics& diagnostics);

/// Hosts are on a CAN interface of this machine; nullptr after an error.
std::unique_ptr<PlantWire> make_interface_wire(can::VirtualBus& bus, const std::string& interface,
                                               base::Diagnostics& diagnostics);

}  // namespace armature::janus
