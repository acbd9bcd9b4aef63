// SPDX-License-Identifier: Apache-2.0
#pragma once

// What comes of a call.

#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "armature/base/time.hpp"

namespace armature::component {

namespace internal {
class PendingCall;
}  // namespace internal
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

/// A call that was sent to another thread, whatever it returns.
class [[nodiscard]] SentCall {
 public:
  explicit SentCall(CallStatus refusal) : refusal_(refusal) {}
  explicit SentCall(internal::PendingCall& call) : call_(&call) {}
  SentCall(SentCall&& other) noexcept
      : call_(std::exchange(other.call_, nullptr)), refusal_(other.refusal_) {}
  SentCall& operator=(SentCall&& other) noexcept {
    std::swap(call_, other.call_);
    std::swap(refusal_, other.refusal_);
    return *this;
  }
  ~SentCall();

  /// False if the call was not taken; `collect` says why.
  bool sent() const { return call_ != nullptr; }
  bool done() const;

  /// Takes the call back if it has not begun; false if it is too late.
  /// @rt nonblocking
  bool cancel();

 protected:
  /// kPending until it is finished.
  CallStatus status() const;
  /// The same, but waits at most `limit`, and then takes it back.
  CallStatus wait_for_status(base::Duration limit);
  /// What it returned, once the status is kDone.
  const void* value() const;

 private:
  internal::PendingCall* call_ = nullptr;
  CallStatus refusal_ = CallStatus::kPending;
};

/// What `send` returns; letting go of it does not cancel the call.
template <typename R>
class [[nodiscard]] SendHandle : public SentCall {
 public:
  using SentCall::SentCall;
  explicit SendHandle(SentCall&& call) : SentCall(std::move(call)) {}

  /// The result if the call is finished, else kPending.
  /// @rt nonblocking; copies the result
  CallResult<R> collect() const { return result_of(status()); }

  /// Waits for the result, at most `limit`; kTimeout then, and the call is taken back if it has not
  /// begun.
  CallResult<R> wait(base::Duration limit) { return result_of(wait_for_status(limit)); }

 private:
  CallResult<R> result_of(CallStatus status) const {
    CallResult<R> result{status};
    if constexpr (!std::is_void_v<R>) {
      if (result) result.value = *static_cast<const std::decay_t<R>*>(value());
    }
    return result;
  }
};

}  // namespace armature::component
