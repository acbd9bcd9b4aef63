// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "robots/wam/driver/wam_driver.hpp"

namespace armature::wam {

/// Why an arm is idle all at once, or a puck silent: the board is given a moment to say it, before
/// anything is called a fault. Nothing is driven meanwhile.
class CauseSearch {
 public:
  enum class Found : std::uint8_t {
    kNothingYet,
    kOperator,  ///< it was idled by hand
    kFault,     ///< the pucks' own
  };

  void forget();
  /// Whether it has begun, and not found anything.
  bool under_way() const { return since_.has_value(); }
  /// @rt nonblocking, no allocation
  void begin(base::Time now) { since_ = now; }

  /// A fault of the board becomes one of the driver; without one it was the operator.
  /// @rt nonblocking, no allocation
  Found look_at_idle(base::Time now);
  /// A puck that answers again has heard that it is idle. Of one that does not, nobody knows what
  /// it drives its motor with: its power is cut.
  /// @rt nonblocking, no allocation
  Found look_at_silence(WamDriver& driver, base::Time now);

 private:
  std::optional<base::Time> since_;
  bool cuts_power_ = false;  ///< has asked for it
};

}  // namespace armature::wam
