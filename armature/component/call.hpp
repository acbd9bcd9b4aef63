// SPDX-License-Identifier: Apache-2.0
#pragma once

// Calls between threads: a record travels to the thread that executes it and keeps the result for
// the caller.

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/ticks.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::component {

/// How a call of an operation stands, or how it ended.
enum class CallStatus : std::uint8_t {
  kDone,
  kPending,       ///< sent, not finished
  kNotConnected,  ///< the caller is bound to no operation
  kNotReady,      ///< the operation's component is not configured, or in an exception
  kFailed,        ///< an exception escaped from the operation; its component has faulted
  kCancelled,
  kQueueFull,    ///< too many calls of this caller are under way; this one was not taken
  kTimeout,      ///< the operation's thread did not answer in time
  kUnreachable,  ///< the operation's component lives elsewhere, and there is no way to it now
  kWouldWait,    ///< it lives elsewhere, and a real-time thread does not wait for it: send the call
};

std::string_view name_of(CallStatus status);

/// The result of a call. `value` is meaningful if the status is kDone.
template <typename R>
struct [[nodiscard]] CallResult {
  CallStatus status = CallStatus::kPending;
  std::decay_t<R> value{};
  explicit operator bool() const { return status == CallStatus::kDone; }
};

/// The result of a call of an operation that returns nothing.
template <>
struct CallResult<void> {
  CallStatus status = CallStatus::kPending;
  explicit operator bool() const { return status == CallStatus::kDone; }
};

/// Memory that two threads share: its pool, the thread that delivers it and the handle. The last
/// one that lets go of it frees it, which is the pool unless its owner was disconnected meanwhile.
///
/// Specification: while anybody uses it, it is neither shared anew nor freed, and it is freed once;
/// whoever shares it anew, or frees it, sees all that was done with it before.
template <typename Atomics>
class BasicSharedRecord {
 public:
  /// Deleter of a handle: lets go of the record.
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
template <typename R>
using CallRecord = BasicCallRecord<R, rt::FutexParker>;

/// What `send` returns; letting go of it does not cancel the call.
template <typename R>
class [[nodiscard]] SendHandle {
 public:
  explicit SendHandle(CallStatus refusal) : refusal_(refusal) {}
  explicit SendHandle(CallRecord<R>& record) : record_(&record) {}
  SendHandle(SendHandle&& other) noexcept
      : record_(std::exchange(other.record_, nullptr)), refusal_(other.refusal_) {}
  SendHandle& operator=(SendHandle&& other) noexcept {
    std::swap(record_, other.record_);
    std::swap(refusal_, other.refusal_);
    return *this;
  }
  ~SendHandle() {
    if (record_ != nullptr) record_->release();
  }

  /// False if the call was not taken; `collect` says why.
  bool sent() const { return record_ != nullptr; }
  bool done() const { return record_ == nullptr || record_->finished(); }

  /// The result if the call is finished, else kPending.
  /// @rt nonblocking; copies the result
  CallResult<R> collect() const {
    if (record_ == nullptr) return {refusal_};
    if (!record_->finished()) return {CallStatus::kPending};
    if (record_->cancelled()) return {CallStatus::kCancelled};
    return record_->result();
  }

  /// Takes the call back if it has not begun; false if it is too late.
  /// @rt nonblocking
  bool cancel() { return record_ != nullptr && record_->try_cancel(); }

  /// Waits for the result, at most `limit`; kTimeout then, and the call is taken back if it has not
  /// begun.
  CallResult<R> wait(base::Duration limit) {
    if (record_ == nullptr) return {refusal_};
    record_->wait_until(base::later(rt::monotonic_now(), limit));
    if (!done()) {
      cancel();
      return {CallStatus::kTimeout};
    }
    return collect();
  }

 private:
  CallRecord<R>* record_ = nullptr;
  CallStatus refusal_ = CallStatus::kPending;
};

}  // namespace armature::component
