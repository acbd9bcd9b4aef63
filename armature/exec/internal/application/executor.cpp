// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/executor.hpp"

#include <string>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/task.hpp"

namespace armature::exec::internal {

bool Executor::run_in_thread_of(component::Component& component, std::function<void()> work) const {
  component::ExecutionContext& context = component::Host::context(component);
  const auto as_its_own = [&component, &context, work = std::move(work)] {
    component::Host::run(component, context, work);
  };
  if (unreachable_.includes(component)) return false;
  if (context.live) {
    // It may die of this work.
    return Task::run_in(context, as_its_own, limit_,
                        [&] { return death_notice_.is_about(context); });
  }
  context.cycle_time = clock_.now();
  as_its_own();
  return true;
}

std::string not_answered(const component::Component& component) {
  return "the thread of " + base::quoted(component.name()) + " did not answer in time";
}

}  // namespace armature::exec::internal
