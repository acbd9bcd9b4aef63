// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"

namespace armature::can {

/// How a host reaches its devices: a bus, the time on it, and waiting for what it brings. The bus
/// is outside this process (`BusLink`), or the host itself lets time pass on it.
class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;

  virtual Bus& bus() = 0;
  /// Opens the bus; `on_news` of the options is the link's own.
  /// @return false after an error, each named in `diagnostics`
  virtual bool open(BusOptions options, base::Diagnostics& diagnostics) = 0;

  /// A run of the host begins.
  /// @param time  of the application
  /// @rt nonblocking, no allocation
  /// @thread the host's, as for what follows
  virtual void begin_run(base::Time time) { begin_cycle(time); }
  /// A cycle of the host begins.
  /// @param time  of the cycle
  /// @rt nonblocking, no allocation
  virtual void begin_cycle(base::Time time) = 0;
  /// The time that it is, for the driver.
  /// @rt nonblocking, no allocation
  virtual base::Time now() = 0;
  /// Returns when frames may have come, or at `deadline`.
  /// @rt no allocation; waits
  virtual void wait_for_news(base::Time deadline) = 0;
};

}  // namespace armature::can
