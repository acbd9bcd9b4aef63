// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <stdexcept>
#include <utility>

#include "armature/component/component.hpp"
#include "armature/component/host.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::benchmarks {

/// Wakes the thread that measures when what it had others do is done.
class Finish {
 public:
  void tell() { wakeup_.notify(); }
  /// Throws if it does not come within 20 s: something that should have happened did not.
  void wait() {
    if (wakeup_.wait_until(platform::monotonic_now() + std::chrono::seconds(20))) return;
    throw std::runtime_error(
        "the threads did not finish within 20 s: a cycle or a wake-up is lost");
  }

 private:
  rt::Wakeup wakeup_;
};

/// Work for a component's own thread. It can be sent again when it is done, without allocating.
class Errand final : public rt::Message {
 public:
  Errand(component::Component& doer, std::function<void()> work)
      : rt::Message(&deliver), doer_(doer), work_(std::move(work)) {}

  void send() { component::Host::context(doer_).post(*this); }

 private:
  static void deliver(rt::Message& message) {
    auto& self = static_cast<Errand&>(message);
    component::Host::run(self.doer_, component::Host::context(self.doer_), self.work_);
  }

  component::Component& doer_;
  std::function<void()> work_;
};

}  // namespace armature::benchmarks
