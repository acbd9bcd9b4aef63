// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/call.hpp"

#include "armature/component/internal/pending_call.hpp"
#include "armature/rt/outbox.hpp"
#include "armature/rt/ticks.hpp"

namespace armature::component {

std::string_view name_of(CallStatus status) {
  switch (status) {
    case CallStatus::kDone:
      return "done";
    case CallStatus::kPending:
      return "pending";
    case CallStatus::kNotConnected:
      return "not connected";
    case CallStatus::kNotReady:
      return "not ready";
    case CallStatus::kFailed:
      return "failed";
    case CallStatus::kCancelled:
      return "cancelled";
    case CallStatus::kQueueFull:
      return "queue full";
    case CallStatus::kTimeout:
      return "timeout";
    case CallStatus::kUnreachable:
      return "unreachable";
    case CallStatus::kWouldWait:
      return "would wait for another process";
  }
  return "unknown";
}

namespace internal {

PendingCall::PendingCall(OperationBase& operation)
    : BasicCallRecord(&PendingCall::deliver),
      operation_(operation),
      arguments_(operation.signature()) {}

void PendingCall::deliver(rt::Message& message) {
  auto& call = static_cast<PendingCall&>(message);
  if (!call.try_begin()) return;
  const Arguments& arguments = call.arguments_;
  const CallStatus status =
      call.operation_.execute_by_message(arguments.places(), arguments.result());
  rt::send_gathered();  // what the operation wrote is on its way before its caller goes on
  call.finish({status});
}

}  // namespace internal

SentCall::~SentCall() {
  if (call_ != nullptr) call_->release();
}

bool SentCall::done() const { return call_ == nullptr || call_->finished(); }

bool SentCall::cancel() { return call_ != nullptr && call_->try_cancel(); }

CallStatus SentCall::status() const {
  if (call_ == nullptr) return refusal_;
  if (!call_->finished()) return CallStatus::kPending;
  return call_->cancelled() ? CallStatus::kCancelled : call_->result().status;
}

CallStatus SentCall::wait_for_status(base::Duration limit) {
  if (call_ == nullptr) return refusal_;
  call_->wait_until(base::later(rt::monotonic_now(), limit));
  if (done()) return status();
  cancel();
  return CallStatus::kTimeout;
}

const void* SentCall::value() const { return call_->value(); }

}  // namespace armature::component
