// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "armature/component/context.hpp"

namespace armature::exec::internal {

/// Counts what components report from their threads, and remembers the first that faulted. What
/// befalls a shadow is no incident of the run: whatever it does, those who drive go on.
class Incidents final : public component::Supervisor {
 public:
  explicit Incidents(std::vector<const component::Component*> shadows = {})
      : shadows_(std::move(shadows)) {}

  void component_faulted(component::Component& component) override {
    const component::Component* none = nullptr;
    first_.compare_exchange_strong(none, &component, std::memory_order_acq_rel,
                                   std::memory_order_relaxed);
    if (!is_shadow(component)) faults_.fetch_add(1, std::memory_order_relaxed);
  }
  /// What somebody has stopped stops its readers by their reactions: that is no fault.
  void component_stopped_itself(component::Component& component) override {
    if (!is_shadow(component)) reactions_.fetch_add(1, std::memory_order_relaxed);
  }

  std::uint64_t faults() const { return faults_.load(std::memory_order_relaxed); }
  std::uint64_t reactions() const { return reactions_.load(std::memory_order_relaxed); }

  /// A shadow counts, too: its fault has a black box. Since the last `take_first`; nullptr if there
  /// was none.
  const component::Component* first() const { return first_.load(std::memory_order_acquire); }
  const component::Component* take_first() {
    return first_.exchange(nullptr, std::memory_order_acq_rel);
  }

 private:
  bool is_shadow(const component::Component& component) const {
    return std::find(shadows_.begin(), shadows_.end(), &component) != shadows_.end();
  }

  const std::vector<const component::Component*> shadows_;
  std::atomic<std::uint64_t> faults_{0};
  std::atomic<std::uint64_t> reactions_{0};
  std::atomic<const component::Component*> first_{nullptr};
};

}  // namespace armature::exec::internal
