// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/can/bus_link.hpp"
#include "armature/can/make_bus.hpp"
#include "armature/controllers/base/guarded_bus.hpp"
#include "armature/guardian/guardian.hpp"
#include "drives/cia402_components/cia402_host.hpp"

namespace armature::cia402 {

/// The host of drives on a CAN interface of this machine, or on the virtual bus of another process,
/// such as armature-cia402-emulator. A guardian stops the drives if this process cannot.
class Cia402Bus final : public Cia402Host {
 public:
  using Cia402Host::Cia402Host;

 private:
  void on_check(component::Check& check) const override {
    Cia402Host::on_check(check);
    if (!can::is_virtual(bus_.get())) check.drives_hardware(bus_.get());
  }
  base::Result<std::unique_ptr<can::Link>> make_link() override {
    return std::unique_ptr<can::Link>(std::make_unique<can::BusLink>(bus_.get(), bit_rate()));
  }
  component::Outcome begin_to_guard() override;
  bool is_guarded() override;
  void rest() override { guard_.rest(); }
  void end_guard() override { guard_.end(); }

  component::Property<std::string> bus_{
      this, "bus", "can0", "the CAN interface, or virtual: and the socket file of another process"};
  controllers::GuardedBus guard_{this};
};

/// What a guardian may do to drives: have them stop quickly at a SYNC, and ask by SYNC whether they
/// are off.
/// @param bus, bit_rate  as `can::make_bus` has them
guardian::Orders guard_orders(const DriveGroup& drives, const std::string& bus,
                              std::uint32_t bit_rate, base::Duration period);

}  // namespace armature::cia402
