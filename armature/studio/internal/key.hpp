// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"

namespace armature::studio::internal {

/// The key that somebody holds down before the robot does what only its operator lets it do. Its
/// renewals are measured where they arrive: those that were held up, and come at once, count for
/// the moment in which they come.
class Key {
 public:
  /// So long it has to be held.
  static constexpr base::Duration kHold = std::chrono::seconds(1);
  /// A longer silence means that it was let go of.
  static constexpr base::Duration kGap = std::chrono::milliseconds(200);

  /// It is down.
  /// @return how long it has been, by its renewals
  base::Duration renew(base::Time now);
  void release() { down_ = false; }
  /// Lets one act through for each time that the key is held; the error says what is missing.
  base::Result<void> use(base::Time now);

 private:
  bool is_down(base::Time now) const { return down_ && now - renewed_at_ <= kGap; }

  bool down_ = false;
  bool used_ = false;  ///< since it was pressed
  base::Time pressed_at_{};
  base::Time renewed_at_{};
};

}  // namespace armature::studio::internal
