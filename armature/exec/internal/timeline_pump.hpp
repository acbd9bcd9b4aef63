// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/timeline.hpp"

namespace armature::exec::internal {

/// Carries what the engines' timelines have to a sink: ticks become time, and what came in parts is
/// put together. A sink that throws gets no more.
class TimelinePump {
 public:
  explicit TimelinePump(TimelineOptions options) : options_(std::move(options)) {}

  /// Has the engines, one for each thread of the plan, keep timelines from now on: one each, or one
  /// in all if they take turns in simulated time.
  void set_engines(const std::vector<Engine*>& engines, const Plan& plan, bool simulated);

  void drain();
  /// In simulated time, where it is done at the expense of what it is about.
  void drain_if_half_full();

 private:
  using Entry = component::Timeline::Entry;
  struct Source {
    std::shared_ptr<component::Timeline> timeline;
    bool open = false;
    Entry opened;
    std::vector<Entry> steps{};  ///< of the stretch that is open
    base::Time done{};           ///< up to here it was at work
    std::uint64_t taken = 0;
    std::uint64_t cut_off = 0;  ///< entries of stretches whose end found no room
    std::uint64_t told_losses = 0;
  };

  void add_source(const component::Timeline::Limits& limits);
  void drain(Source& source);
  void take(Source& source, const Entry& entry);
  void tell_stretch(Source& source, const Entry& closed);
  void tell_losses(Source& source);
  TimelineSlice slice_of(const Source& source) const;
  void tell(const TimelineSlice& slice) noexcept;

  TimelineOptions options_;
  double tick_ns_ = 1.0;
  std::vector<Engine*> engines_;
  std::vector<Source> sources_;
};

}  // namespace armature::exec::internal
