// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "armature/component/component.hpp"
#include "armature/exec/internal/application/clock.hpp"
#include "armature/exec/internal/application/death_notice.hpp"
#include "armature/exec/internal/application/unreachable.hpp"

namespace armature::exec::internal {

/// Has the controlling thread's wishes carried out by the threads of the components concerned.
class Executor {
 public:
  Executor(const Clock& clock, const Unreachable& unreachable, const DeathNotice& death_notice,
           base::Duration limit)
      : clock_(clock), unreachable_(unreachable), death_notice_(death_notice), limit_(limit) {}

  /// Runs `work`, as code of `component`, in its thread, or here if that thread does not run; false
  /// if it was not done within the limit, its thread hangs, or dies of it.
  bool run_in_thread_of(component::Component& component, std::function<void()> work) const;
  /// The cycle time of the thread that did the last work.
  base::Time done_at() const { return done_at_; }

 private:
  const Clock& clock_;
  const Unreachable& unreachable_;
  const DeathNotice& death_notice_;
  const base::Duration limit_;
  mutable base::Time done_at_{};
};

/// What to say if `run_in_thread_of` is false.
std::string not_answered(const component::Component& component);

}  // namespace armature::exec::internal
