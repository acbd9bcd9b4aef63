// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "armature/can/link.hpp"
#include "armature/can/virtual_bus.hpp"
#include "drives/cia402/emulated_bus.hpp"

namespace armature::cia402 {

/// Emulated drives in their host's own thread, which lets time pass there whenever it looks.
class EmulatedLink final : public can::Link {
 public:
  enum class Time {
    kSimulated,  ///< waiting takes no time: the bus runs ahead of the application's clock
    kReal,       ///< on the monotonic clock
  };

  /// @param now  when the drives are switched on
  static base::Result<std::unique_ptr<EmulatedLink>> make(EmulatedBus::Config config, Time time,
                                                          base::Time now);

  can::Bus& bus() override { return *host_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override;
  void begin_run(base::Time time) override;
  void begin_cycle(base::Time time) override;
  base::Time now() override { return now_; }
  void wait_for_news(base::Time deadline) override;

  EmulatedBus& drives() { return *drives_; }
  /// By which the host is on the bus.
  can::VirtualStation& station() { return *host_; }

 private:
  explicit EmulatedLink(Time time, base::Time now) : time_(time), now_(now) {}
  void advance_to(base::Time now);

  const Time time_;
  base::Time now_;
  base::Duration ahead_{};  ///< of the application's clock, by what was waited before its run
  std::unique_ptr<EmulatedBus> drives_;
  can::VirtualStation* host_ = nullptr;
};

}  // namespace armature::cia402
