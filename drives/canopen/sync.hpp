// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"

namespace armature::canopen {

/// Makes the SYNC of each cycle (CiA 301, 7.2.5).
class SyncProducer {
 public:
  /// @param overflow  the counter runs from 1 to this, 2 to 240; 0: SYNC has no counter
  explicit SyncProducer(std::uint8_t overflow = 0, std::uint32_t cob_id = cob_id::kSync)
      : overflow_(overflow), cob_id_(cob_id) {}

  /// @rt nonblocking, no allocation
  can::Frame step() noexcept;

 private:
  std::uint8_t overflow_;
  std::uint32_t cob_id_;
  std::uint8_t counter_ = 0;
};

/// Watches SYNC on the side of a device.
class SyncConsumer {
 public:
  /// What a frame is.
  enum class Heard : std::uint8_t {
    kOtherFrame,
    kSync,
    kWrongLength,  ///< a counter where none is expected, or none where one is
  };

  /// @param overflow  as the producer has it
  explicit SyncConsumer(std::uint8_t overflow = 0, std::uint32_t cob_id = cob_id::kSync)
      : overflow_(overflow), cob_id_(cob_id) {}

  /// @param timeout  after a SYNC; 0: it is not missed
  /// @rt nonblocking, no allocation
  void set_timeout(base::Duration timeout) noexcept { timeout_ = timeout; }
  /// @rt nonblocking, no allocation
  Heard take(const can::Frame& frame, base::Time time) noexcept;
  /// Whether SYNC has been heard, and then not in time.
  /// @rt nonblocking, no allocation
  bool missing(base::Time now) const noexcept;
  /// Nothing has been heard yet.
  /// @rt nonblocking, no allocation
  void forget() noexcept { heard_.reset(); }
  /// How many counters did not follow the one before.
  std::uint32_t skips() const { return skips_; }

 private:
  std::uint8_t overflow_;
  std::uint32_t cob_id_;
  base::Duration timeout_{};
  std::optional<base::Time> heard_;
  std::uint8_t counter_ = 0;
  std::uint32_t skips_ = 0;
};

}  // namespace armature::canopen
