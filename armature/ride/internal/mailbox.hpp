// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "armature/ride/internal/handed_over.hpp"

namespace armature::ride::internal {

class Link;

/// What other threads, and a node's thread itself, leave for that thread to do in its next round.
/// Keeps its memory. Whoever leaves something wakes the thread.
class Mailbox {
 public:
  struct Letters {
    Letters();

    std::vector<std::function<void()>> tasks;
    std::vector<std::shared_ptr<Link>> attention;  ///< their connection has ended
    std::vector<std::shared_ptr<Link>> flushes;    ///< what they have gathered is to be sent
    std::vector<std::shared_ptr<Link>> returns;    ///< a caller reads them
  };
  static constexpr std::size_t kUsual = 64;  ///< more links at once ask for memory

  /// @return false once it is closed: `task` is the caller's still
  /// @thread any
  bool post(std::function<void()>& task);
  /// @thread any
  void attend(std::shared_ptr<Link> link);
  void flush(std::shared_ptr<Link> link);
  void take_back(std::shared_ptr<Link> link);
  /// A message that a caller has received for the node.
  /// @return false if there is no room for it: it is lost
  /// @thread any
  bool hand_over(Link& link, const Message& message);

  /// @thread any
  bool empty() const { return !has_messages() && !has_letters_.load(std::memory_order_acquire); }
  bool has_messages() const { return has_messages_.load(std::memory_order_acquire); }

  /// Gives what was handed over to `take(Link&, const Message&)`, in its order.
  /// @thread the node's
  template <typename Take>
  void take_messages(const Take& take) {
    const std::lock_guard lock(mutex_);
    has_messages_.store(false);
    messages_.take_all(take);
  }
  /// Everything but messages; valid, and to be cleared, until the next call.
  /// @thread the node's
  Letters& open();
  /// Takes no more tasks.
  /// @return those that nobody has done
  /// @thread the node's
  std::vector<std::function<void()>> close();

 private:
  std::mutex mutex_;
  Letters letters_;
  Letters opened_;  ///< of the node's thread
  HandedOver messages_;
  bool closed_ = false;
  std::atomic<bool> has_letters_{false};
  std::atomic<bool> has_messages_{false};
};

}  // namespace armature::ride::internal
