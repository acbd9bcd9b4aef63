// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"

namespace armature::component {

/// Something whose configuration waits for a person, such as one who walks to a pendant: it is not
/// taken for one that hangs before that person has had the time. Nothing of it moves meanwhile.
class WaitsForOperator {
 public:
  /// For how long at most, besides what a hook may take.
  /// @thread any, before the configuration
  virtual base::Duration operators_patience() const = 0;

 protected:
  ~WaitsForOperator() = default;
};

}  // namespace armature::component
