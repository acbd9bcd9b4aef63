// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "robots/janus/aic_host.hpp"
#include "robots/janus/can_link.hpp"

namespace armature::janus {

/// The host of AIC cards on a CAN interface of this machine.
class AicBus final : public AicHost {
 public:
  using AicHost::AicHost;

 private:
  base::Result<std::unique_ptr<AicLink>> make_link() override {
    return std::unique_ptr<AicLink>(std::make_unique<CanLink>(interface_.get()));
  }

  component::Property<std::string> interface_{this, "bus", "can0", "the CAN interface"};
};

}  // namespace armature::janus
