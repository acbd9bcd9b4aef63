// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "armature/platform/thread.hpp"
#include "armature/ride/internal/link.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::ride::internal {

/// Brings up connections whose handshake takes long to compute, one after the other in their order,
/// in a thread of its own: strangers who shake hands all day hold up no message of others.
///
/// That thread runs while nobody else wants its CPU, so it takes no lock: whoever waited for it
/// would wait as long as others compute.
/// @thread the node's
class Handshakes {
 public:
  /// @param name    of the thread, which begins with the first connection
  /// @param settle  goes on with a link whose handshake went as far as it could
  /// @param wake    has the node call `take_done`; called by the thread
  Handshakes(std::string name, std::function<void(Link&, Progress)> settle,
             std::function<void()> wake)
      : name_(std::move(name)), settle_(std::move(settle)), wake_(std::move(wake)) {}
  Handshakes(const Handshakes&) = delete;
  Handshakes& operator=(const Handshakes&) = delete;
  ~Handshakes() { stop(); }

  /// Takes the next step of a link that is held.
  void add(std::shared_ptr<Link> link);
  /// Settles those that went as far as they could.
  void take_done() {
    if (!done_.empty()) settle(done_);
  }
  /// Ends the thread; what has waited for it goes no further.
  void stop();

 private:
  struct Job;

  void run();
  void settle(rt::Inbox& jobs);

  const std::string name_;
  const std::function<void(Link&, Progress)> settle_;
  const std::function<void()> wake_;
  rt::Inbox wanted_;
  rt::Inbox done_;
  rt::BasicWakeup<rt::FutexParker> changed_;
  std::atomic<bool> ends_{false};
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::ride::internal
