// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/exec/internal/application/engines.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/plan.hpp"
#include "armature/exec/thread_watch.hpp"

namespace armature::exec::internal {

/// Numbers that tools look at again and again while the application runs: each thread copies its
/// own after a cycle, so that a look is no message to anybody.
/// @thread the controlling one
class Watches {
 public:
  Watches(const Plan& plan, const Roster& roster, const Engines& engines, const Executor& executor)
      : plan_(plan), roster_(roster), engines_(engines), executor_(executor) {}

  /// @return its handle; the error says whose thread does not answer
  base::Result<std::int32_t> begin(const std::vector<WatchedNumber>& numbers,
                                   base::Duration interval);
  /// What the threads have copied last; nullptr if there is no such watch.
  const WatchSample* newest(std::int32_t handle);
  /// No effect if there is none.
  void end(std::int32_t handle);

  /// The threads have ended: nobody copies any more.
  void end_all();
  /// What a hanging thread may still write to.
  std::vector<std::shared_ptr<ThreadWatch>> give_away();

 private:
  /// The numbers that one thread copies, and where they are in the sample.
  struct Part {
    std::shared_ptr<ThreadWatch> watch;
    std::vector<std::size_t> places;
    std::uint64_t taken = 0;  ///< the number of the last picture
  };
  struct Watch {
    std::vector<Part> parts;
    WatchSample sample;
  };

  bool attach(const std::shared_ptr<ThreadWatch>& watch);
  void detach(const Part& part);
  void take(Part& part, WatchSample& into);
  Engine& engine_of(const component::Component& component) const;

  const Plan& plan_;
  const Roster& roster_;
  const Engines& engines_;
  const Executor& executor_;
  std::map<std::int32_t, Watch> watches_;
  std::int32_t last_handle_ = 0;
  /// Of threads that did not answer: they may still come to it.
  std::vector<std::shared_ptr<ThreadWatch>> abandoned_;
};

}  // namespace armature::exec::internal
