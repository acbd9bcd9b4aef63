// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/task.hpp"

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
                  base::Duration limit) {
  const std::shared_ptr<Task> task = send(context, std::move(work));
  const base::Time deadline = base::later(platform::monotonic_now(), limit);
  while (!task->done_.load(std::memory_order_acquire)) {
    if (!task->finished_.wait_until(deadline)) break;
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
