// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"
#include "armature/component/ports/input_port.hpp"

namespace armature::controllers {

/// Whether there is a value, written since the component started: what was desired or measured
/// before a start says nothing about now, however lately it was.
template <typename T>
bool is_of_this_run(const component::Reading<T>& reading, base::Time started) {
  return reading.status >= component::ReadStatus::kOld && reading.time >= started;
}

}  // namespace armature::controllers
