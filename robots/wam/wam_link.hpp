// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"

namespace armature::wam {

/// How a host reaches the arm: a bus, the time on it, and waiting for what it brings.
class WamLink {
 public:
  WamLink() = default;
  WamLink(const WamLink&) = delete;
  WamLink& operator=(const WamLink&) = delete;
  virtual ~WamLink() = default;

  virtual can::Bus& bus() = 0;
  /// Opens the bus; `on_news` of the options is the link's own.
  /// @return false after an error, each named in `diagnostics`
  virtual bool open(can::BusOptions options, base::Diagnostics& diagnostics) = 0;

  /// A run of the host begins.
  /// @param time  of the application
  virtual void begin_run(base::Time time) = 0;
  /// A cycle of the host begins.
  /// @param time  of the cycle
  /// @rt nonblocking, no allocation
  /// @thread the host's, as for what follows
  virtual void begin_cycle(base::Time time) = 0;
  /// The time that it is, for the driver.
  /// @rt nonblocking, no allocation
  virtual base::Time now() = 0;
  /// Returns when frames may have come, or at `deadline`.
  /// @rt no allocation; waits
  virtual void wait_for_news(base::Time deadline) = 0;
};

}  // namespace armature::wam
