// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/observing/cycle_record.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/recorded_cycle.hpp"

namespace armature::exec::internal {

/// Cycles that tools look at: each look has the thread record its next one. Who does not look costs
/// the threads nothing.
/// @thread the controlling one
class CycleRecords {
 public:
  /// Steps of a cycle.
  static constexpr std::size_t kMostSteps = 2048;

  CycleRecords(const Blueprint& blueprint, const Plan& plan, const Engines& engines,
               const Executor& executor)
      : blueprint_(blueprint), plan_(plan), engines_(engines), executor_(executor) {}

  /// The one that was recorded last. The error: there is no such thread, or it does not answer.
  base::Result<RecordedCycle> look(std::string_view thread);

  /// The threads have ended: nobody records any more.
  void end_all() { places_.clear(); }
  /// What a hanging thread may still write to.
  std::vector<std::shared_ptr<component::CycleRecord>> give_away();

 private:
  /// Of a thread.
  struct Place {
    std::shared_ptr<component::CycleRecord> record;
    bool asked = false;  ///< the thread has the record
    RecordedCycle last;
  };

  base::Result<void> ask(Index thread, Place& place);

  const Blueprint& blueprint_;
  const Plan& plan_;
  const Engines& engines_;
  const Executor& executor_;
  std::map<Index, Place> places_;
};

}  // namespace armature::exec::internal
