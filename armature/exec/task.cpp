// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/task.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {

std::shared_ptr<Task> Task::send(component::ExecutionContext& context, std::function<void()> work) {
  std::shared_ptr<Task> task(new Task(std::move(work)));
  task->self_ = task;
  context.post(*task);
  return task;
}

void Task::post(component::ExecutionContext& context, std::function<void()> work) {
  send(context, std::move(work));
}

bool Task::run_in(component::ExecutionContext& context, std::function<void()> work,
                  base::Duration limit, const std::function<bool()>& in_vain) {
  constexpr base::Duration kGlance = std::chrono::milliseconds(20);
  const std::shared_ptr<Task> task = send(context, std::move(work));
  const base::Time deadline = base::later(platform::monotonic_now(), limit);
  while (!task->done_.load(std::memory_order_acquire)) {
    const base::Time now = platform::monotonic_now();
    if (now >= deadline || (in_vain && in_vain())) break;
    task->finished_.wait_until(in_vain ? std::min(deadline, base::later(now, kGlance)) : deadline);
  }
  return task->done_.load(std::memory_order_acquire);
}

void Task::deliver(rt::Message& message) {
  auto& task = static_cast<Task&>(message);
  const rt::PermitScope permit;  // asked for by a tool, not part of the control loop
  const std::shared_ptr<Task> keep = std::move(task.self_);
  task.work_();
  task.done_.store(true, std::memory_order_release);
  task.finished_.notify();
}

}  // namespace armature::exec
