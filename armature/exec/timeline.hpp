// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "armature/base/time.hpp"

namespace armature::exec {

/// Something that a thread did, from begin to end. The slices of a thread come in the order of
/// their time, each stretch before its steps.
struct TimelineSlice {
  /// What a slice is.
  enum class Kind : std::uint8_t {
    kCycle,     ///< a stretch: one cycle
    kMessages,  ///< a stretch: what was sent to the thread between two cycles
    kStep,      ///< within the stretch before: a component ran, without what it called
    kLost,      ///< no time: entries that found no room
  };
  Kind kind = Kind::kCycle;
  std::size_t thread = 0;  ///< counts from 0
  std::string_view thread_name;
  std::string_view component;  ///< of a step
  base::Time begin{};
  base::Duration length{};
  std::uint64_t cycle = 0;    ///< the thread's, counted from 1
  base::Time cycle_time{};    ///< what components were told
  bool detailed = false;      ///< of a stretch: its steps follow
  std::uint64_t missing = 0;  ///< of a stretch: those not kept before it; kLost: entries
};

/// Takes the slices of an application's threads; called by the controlling thread.
struct TimelineOptions {
  std::function<void(const TimelineSlice&)> sink;  ///< empty: no timeline
  /// Of a thread's time that it may cost, in the long run: so much is shown step by step.
  double share = 0.05;
};

}  // namespace armature::exec
