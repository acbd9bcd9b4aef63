// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/controllers/base/guarded_bus.hpp"
#include "robots/janus/aic/aic_host.hpp"

namespace armature::janus {

/// The host of AIC cards on a CAN interface of this machine, or on the virtual bus of another
/// process, such as armature-janus-plant. A guardian switches the cards off if this process cannot.
class AicBus final : public AicHost {
 public:
  using AicHost::AicHost;

 private:
  void on_check(component::Check& check) const override {
    if (!can::is_virtual(bus_.get())) check.drives_hardware(bus_.get());
  }
  base::Result<std::unique_ptr<can::Link>> make_link() override {
    return std::unique_ptr<can::Link>(std::make_unique<can::BusLink>(bus_.get(), bit_rate()));
  }
  component::Outcome begin_to_guard() override;
  bool is_guarded() override;
  void rest() override { guard_.rest(); }
  void end_guard() override { guard_.end(); }
  std::uint32_t bit_rate() const { return static_cast<std::uint32_t>(bit_rate_.get()); }

  component::Property<std::string> bus_{
      this, "bus", "can0", "the CAN interface, or virtual: and the socket file of another process"};
  component::Property<int> bit_rate_{this,
                                     "bit_rate",
                                     static_cast<int>(kBitRate),
                                     "of this host on a virtual bus; an interface has its own",
                                     "",
                                     component::range(1, 1'000'000)};
  controllers::GuardedBus guard_{this};
};

}  // namespace armature::janus
