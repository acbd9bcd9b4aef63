// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/can/socket_can.hpp"
#include "armature/rt/wakeup.hpp"
#include "robots/janus/aic_link.hpp"

namespace armature::janus {

/// Cards on a CAN interface of this machine.
class CanLink final : public AicLink {
 public:
  /// @param interface  such as can0
  explicit CanLink(const std::string& interface);

  can::Bus& bus() override { return bus_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override;
  void wait_for_news(base::Time deadline) override;

 private:
  rt::Wakeup news_;
  can::SocketCan bus_;
};

}  // namespace armature::janus
