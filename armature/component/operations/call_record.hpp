// SPDX-License-Identifier: Apache-2.0
#pragma once

// Calls between threads: a record travels to the thread that executes it and keeps the result for
// the caller.

#include <cstdint>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/component/operations/call.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::component {

/// Memory that two threads share: its pool, the thread that delivers it and the handle. The last
/// one that lets go of it frees it, which is the pool unless its owner was disconnected meanwhile.
///
/// Specification: while anybody uses it, it is neither shared anew nor freed, and it is freed once;
/// whoever shares it anew, or frees it, sees all that was done with it before.
template <typename Atomics>
class BasicSharedRecord {
 public:  /// Deleter of a handle: lets go of the record.
  struct LetGo {
    void operator()(BasicSharedRecord* record) const { record->release(); }
  };
  virtual ~BasicSharedRecord() = default;

  /// For a thread to deliver it and a handle to look at it; false while one of them still does.
  /// @thread the pool's
  bool try_share() {
    if (users_.load(std::memory_order_acquire) != kPool) return false;
    users_.store(kAll, std::memory_order_relaxed);
    return true;
  }
  void share_once_more() { users_.fetch_add(1, std::memory_order_relaxed); }
  void release() {
    if (users_.fetch_add(kOneLess, std::memory_order_acq_rel) == 1) dispose();
  }

 protected:
  /// Nobody uses it any more.
  virtual void dispose() { delete this; }

 private:
  static constexpr std::uint64_t kPool = 1;
  static constexpr std::uint64_t kAll = 3;
  static constexpr std::uint64_t kOneLess = ~std::uint64_t{0};
  typename Atomics::template Atomic<std::uint64_t> users_{kPool};
};
using SharedRecord = BasicSharedRecord<rt::StdAtomics>;

/// A call on its way: queued -> running -> finished; a queued one may be cancelled.
///
/// Specification: a call is executed or cancelled, never both; whoever sees it finished sees the
/// result, and a thread that waits for it wakes.
template <typename R, typename Parker>
class BasicCallRecord : public rt::BasicMessage<typename Parker::Atomics>,
                        public BasicSharedRecord<typename Parker::Atomics> {
 public:
  using rt::BasicMessage<typename Parker::Atomics>::BasicMessage;

  /// @thread the caller's
  bool try_claim() {
    if (!this->try_share()) return false;
    stage_.store(kQueued, std::memory_order_relaxed);
    return true;
  }
  bool try_cancel() {
    std::uint32_t expected = kQueued;
    return stage_.compare_exchange_strong(expected, kCancelled, std::memory_order_acq_rel,
                                          std::memory_order_acquire);
  }
  bool finished() const { return stage_.load(std::memory_order_acquire) >= kFinished; }
  bool cancelled() const { return stage_.load(std::memory_order_acquire) == kCancelled; }
  const CallResult<R>& result() const { return result_; }
  void wait_until(base::Time deadline) {
    while (!finished() && done_.wait_until(deadline)) {
    }
  }

  /// @thread the executing one
  bool try_begin() {
    std::uint32_t expected = kQueued;
    if (stage_.compare_exchange_strong(expected, kRunning, std::memory_order_acq_rel,
                                       std::memory_order_acquire)) {
      return true;
    }
    this->release();
    return false;
  }
  void finish(CallResult<R>&& result) {
    result_ = std::move(result);
    stage_.store(kFinished, std::memory_order_release);
    done_.notify();
    this->release();
  }

 private:
  static constexpr std::uint32_t kQueued = 0;
  static constexpr std::uint32_t kRunning = 1;
  static constexpr std::uint32_t kFinished = 2;
  static constexpr std::uint32_t kCancelled = 3;

  typename Parker::Atomics::template Atomic<std::uint32_t> stage_{kQueued};
  rt::BasicWakeup<Parker> done_;
  CallResult<R> result_{};
};

}  // namespace armature::component
