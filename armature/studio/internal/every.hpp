// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"

namespace armature::studio::internal {

/// Something to be done each `period`.
class Every {
 public:
  explicit Every(base::Duration period) : period_(period) {}
  bool is_due(base::Time now) {
    if (now < due_) return false;
    due_ = now + period_;
    return true;
  }

 private:
  const base::Duration period_;
  base::Time due_ = base::Time::min();
};

}  // namespace armature::studio::internal
