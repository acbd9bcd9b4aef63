// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "armature/component/context.hpp"

namespace armature::exec::internal {

/// Counts what components report from their threads.
class Incidents final : public component::Supervisor {
 public:
  void component_faulted(component::Component&) override { count(faults_); }
  void component_stopped_itself(component::Component&) override { count(reactions_); }

  std::uint64_t faults() const { return faults_.load(std::memory_order_relaxed); }
  std::uint64_t reactions() const { return reactions_.load(std::memory_order_relaxed); }

 private:
  static void count(std::atomic<std::uint64_t>& counter) {
    counter.fetch_add(1, std::memory_order_relaxed);
  }

  std::atomic<std::uint64_t> faults_{0};
  std::atomic<std::uint64_t> reactions_{0};
};

}  // namespace armature::exec::internal
