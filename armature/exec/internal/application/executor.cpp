// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/executor.hpp"

#include <memory>
#include <string>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/task.hpp"

namespace armature::exec::internal {

bool Executor::run_in_thread_of(component::Component& component, std::function<void()> work) const {
  component::ExecutionContext& context = component::Host::context(component);
  // Shared: a thread that answers too late still uses it.
  const auto at = std::make_shared<base::Time>();
  const auto as_its_own = [&component, &context, at, work = std::move(work)] {
    *at = context.cycle_time;
    component::Host::run(component, context, work);
  };
  if (unreachable_.includes(component)) return false;
  if (context.live) {
    // It may die of this work.
    const bool done =
        Task::run_in(context, as_its_own, limit_, [&] { return death_notice_.is_about(context); });
    if (done) done_at_ = *at;
    return done;
  }
  context.cycle_time = clock_.now();
  as_its_own();
  done_at_ = *at;
  return true;
}

std::string not_answered(const component::Component& component) {
  return "the thread of " + base::quoted(component.name()) + " did not answer in time";
}

}  // namespace armature::exec::internal
