// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::can {

/// Of a virtual bus that has no time of its own, since its frames have had theirs on an interface:
/// 1 ns a bit.
constexpr std::uint32_t kTimelessBitRate = 1'000'000'000;

/// What connects the virtual bus of a plant with hosts in other processes. One thread takes,
/// advances the bus, gives, and waits.
class HostWire {
 public:
  HostWire() = default;
  HostWire(const HostWire&) = delete;
  HostWire& operator=(const HostWire&) = delete;
  virtual ~HostWire() = default;

  /// What hosts have sent goes to the virtual bus; never waits.
  virtual void take() = 0;
  /// What came for them on the virtual bus goes to the hosts; never waits.
  virtual void give() = 0;
  /// Waits until hosts may have sent something, or until `deadline`.
  virtual void wait_until(base::Time deadline) = 0;
};

/// Hosts connect to a socket file; nullptr after an error.
std::unique_ptr<HostWire> make_shared_wire(VirtualBus& bus, const std::string& path,
                                           base::Diagnostics& diagnostics);

/// Hosts are on a CAN interface of this machine; nullptr after an error.
/// @param bus  with `kTimelessBitRate`
std::unique_ptr<HostWire> make_interface_wire(VirtualBus& bus, const std::string& interface,
                                              base::Diagnostics& diagnostics);

}  // namespace armature::can
