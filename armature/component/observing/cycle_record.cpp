// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/cycle_record.hpp"

namespace armature::component {

/// What a component goes on with right after itself is one step.
void CycleRecord::add_step(const Component* ran, std::uint64_t begin, std::uint64_t end) noexcept {
  if (ran == nullptr) return;
  if (count_ > 0 && steps_[count_ - 1].component == ran && steps_[count_ - 1].end == begin) {
    steps_[count_ - 1].end = end;
  } else if (count_ < steps_.size()) {
    steps_[count_++] = {ran, begin, end};
  } else {
    ++left_out_;
  }
}

}  // namespace armature::component
