// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/component/context.hpp"

namespace armature::exec::internal {

/// Counts what components report from their threads, and remembers the first that faulted.
class Incidents final : public component::Supervisor {
 public:
  void component_faulted(component::Component& component) override {
    const component::Component* none = nullptr;
    first_.compare_exchange_strong(none, &component, std::memory_order_acq_rel,
                                   std::memory_order_relaxed);
    faults_.fetch_add(1, std::memory_order_relaxed);
  }
  /// What somebody has stopped stops its readers by their reactions: that is no fault.
  void component_stopped_itself(component::Component&) override {
    reactions_.fetch_add(1, std::memory_order_relaxed);
  }

  std::uint64_t faults() const { return faults_.load(std::memory_order_relaxed); }
  std::uint64_t reactions() const { return reactions_.load(std::memory_order_relaxed); }

  /// Since the last `take_first`; nullptr if there was none.
  const component::Component* first() const { return first_.load(std::memory_order_acquire); }
  const component::Component* take_first() {
    return first_.exchange(nullptr, std::memory_order_acq_rel);
  }

 private:
  std::atomic<std::uint64_t> faults_{0};
  std::atomic<std::uint64_t> reactions_{0};
  std::atomic<const component::Component*> first_{nullptr};
};

}  // namespace armature::exec::internal
