// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a component keeps apart from what its handlers touch.

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/interface.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/step.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/statistics.hpp"

namespace armature::component {

struct internal::Inside::ReportedFault final : rt::Signal {
  explicit ReportedFault(Component& component) : rt::Signal(&deliver), self(component) {}
  static void deliver(rt::Message& message);
  Component& self;
  std::atomic<bool> taken{false};
  Reason reason;
};

struct Component::Rest {
  Rest(Component& component, std::string component_name)
      : name(std::move(component_name)), reported_fault(component) {}

  std::string name;
  bool configured = false;
  base::Time ages_hold_until{};  ///< no input needs a look at its age before
  Pace pace;
  Interface interface;
  std::vector<Step*> steps_before;
  std::vector<Step*> steps_after;
  Reason reason;
  internal::Inside::ReportedFault reported_fault;
  // Last, being large: what a transition touches lies close together.
  std::uint64_t measured_ticks = 0;
  Component* next_measured = nullptr;
  bool measured = false;
  rt::Distribution execution_ticks;
};

}  // namespace armature::component
