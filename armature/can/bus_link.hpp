// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "armature/can/link.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::can {

/// To devices on a bus outside this process, on the monotonic clock.
class BusLink final : public Link {
 public:
  /// @param bus       as `make_bus` has it: can0, virtual:/tmp/janus.bus
  /// @param bit_rate  of this station on a virtual bus
  BusLink(const std::string& bus, std::uint32_t bit_rate);

  Bus& bus() override { return *bus_; }
  bool open(BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

 private:
  rt::Wakeup news_;
  std::unique_ptr<Bus> bus_;
};

}  // namespace armature::can
