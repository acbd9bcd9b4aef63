// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "armature/can/bus.hpp"
#include "armature/rt/wakeup.hpp"
#include "robots/janus/aic_link.hpp"

namespace armature::janus {

/// Cards on a CAN bus outside this process.
class CanLink final : public AicLink {
 public:
  /// @param bus       as `can::make_bus` has it: can0, virtual:/tmp/janus.bus
  /// @param bit_rate  of this station on a virtual bus
  CanLink(const std::string& bus, std::uint32_t bit_rate);

  can::Bus& bus() override { return *bus_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

 private:
  rt::Wakeup news_;
  std::unique_ptr<can::Bus> bus_;
};

}  // namespace armature::janus
