// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "armature/base/time.hpp"
#include "armature/component/context.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::exec {

/// Work that another thread hands to an engine: life-cycle changes, questions of tools. It must not
/// throw, and owns what it needs, since it may be done when nobody waits for it any more.
class Task final : public rt::Message {
 public:
  /// Hands `work` to the thread of `context`.
  static void post(component::ExecutionContext& context, std::function<void()> work);

  /// The same, and waits until it is done, at most `limit`, or until that is `in_vain`; false if it
  /// was not done by then.
  static bool run_in(component::ExecutionContext& context, std::function<void()> work,
                     base::Duration limit, const std::function<bool()>& in_vain = {});

 private:
  explicit Task(std::function<void()> work) : rt::Message(&Task::deliver), work_(std::move(work)) {}
  static std::shared_ptr<Task> send(component::ExecutionContext& context,
                                    std::function<void()> work);
  static void deliver(rt::Message& message);

  std::function<void()> work_;
  std::atomic<bool> done_{false};
  rt::Wakeup finished_;
  std::shared_ptr<Task> self_;  ///< while it is on its way
};

}  // namespace armature::exec
