// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/can/bus.hpp"
#include "armature/rt/wakeup.hpp"
#include "robots/wam/wam_link.hpp"

namespace armature::wam {

/// An arm on a CAN bus outside this process.
class CanLink final : public WamLink {
 public:
  /// @param bus  as `can::make_bus` has it: can0, virtual:/tmp/wam.bus
  explicit CanLink(const std::string& bus);

  can::Bus& bus() override { return *bus_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_run(base::Time /*time*/) override {}
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

 private:
  rt::Wakeup news_;
  std::unique_ptr<can::Bus> bus_;
};

}  // namespace armature::wam
