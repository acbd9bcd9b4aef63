// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "armature/platform/thread.hpp"

namespace armature::ride::internal {

class Link;

/// Brings up connections whose handshake takes long to compute, one after the other in their order,
/// in a thread of its own: strangers who shake hands all day hold up no message of others.
class Handshakes {
 public:
  using Done = std::function<void(const std::shared_ptr<Link>& link, bool established)>;

  /// @param name  of the thread, which begins with the first connection
  /// @param done  is called by that thread each time that a handshake went as far as it could
  Handshakes(std::string name, Done done) : name_(std::move(name)), done_(std::move(done)) {}
  Handshakes(const Handshakes&) = delete;
  Handshakes& operator=(const Handshakes&) = delete;
  ~Handshakes() { stop(); }

  /// Takes the link's next steps.
  /// @thread the node's
  void add(std::shared_ptr<Link> link);
  /// Ends the thread; what has waited for it goes no further.
  /// @thread the node's
  void stop();

 private:
  void run();
  std::shared_ptr<Link> wait_for_next();

  const std::string name_;
  const Done done_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Link>> waiting_;
  bool ends_ = false;
  std::unique_ptr<platform::Thread> thread_;
};

}  // namespace armature::ride::internal
