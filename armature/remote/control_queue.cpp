// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/control_queue.hpp"

#include <utility>

namespace armature::remote {

bool ControlQueue::post(Work work) {
  const std::lock_guard lock(mutex_);
  if (closed_ || waiting_.size() >= kCapacity) return false;
  waiting_.push_back(std::move(work));
  return true;
}

bool ControlQueue::has_room() const {
  const std::lock_guard lock(mutex_);
  return !closed_ && waiting_.size() < kCapacity;
}

void ControlQueue::run() {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return;
    waiting_.swap(taken_);
  }
  for (Work& work : taken_) work();
  taken_.clear();
}

void ControlQueue::close() {
  std::vector<Work> left;
  const std::lock_guard lock(mutex_);
  closed_ = true;
  left.swap(waiting_);
}

}  // namespace armature::remote
