// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/open_calls.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace armature::ride::internal {
namespace {

void give_answer(OpenCall& call, std::span<const std::byte> result,
                 const std::shared_ptr<MemoryShare>& share) {
  Holding holding(share);
  try {
    call.answered(result, holding);
  } catch (const std::bad_alloc&) {
    call.refused(Code::kTooLarge, "not enough memory for the answer");
  }
}

}  // namespace

void OpenCalls::add(OpenCall& call) {
  call.id = ++last_id_ != 0 ? last_id_ : ++last_id_;  // 0 is the identifier of no call
  calls_.push_back(&call);
}

bool OpenCalls::has(std::uint32_t id) const {
  return std::ranges::find(calls_, id, &OpenCall::id) != calls_.end();
}

OpenCall* OpenCalls::remove(std::uint32_t id) {
  const auto at = std::ranges::find(calls_, id, &OpenCall::id);
  if (at == calls_.end()) return nullptr;
  OpenCall* const call = *at;
  calls_.erase(at);
  return call;
}

bool OpenCalls::complete(const Message& message, const std::shared_ptr<MemoryShare>& share) {
  if (message.header.type == Type::kReply) {
    OpenCall* const call = remove(message.header.identifier);
    if (call != nullptr) give_answer(*call, message.body, share);
    return call != nullptr;
  }
  Decoder from(message.body);
  Control control;
  if (!from.take(control) || !from.ended()) return false;
  OpenCall* const call = remove(message.header.identifier);
  if (call != nullptr) call->refused(control.code, control.text);
  return call != nullptr;
}

WaitingCall* OpenCalls::first_waiting() const {
  const auto first = std::ranges::find_if(calls_, [](const OpenCall* call) { return call->waits; });
  return first != calls_.end() ? static_cast<WaitingCall*>(*first) : nullptr;
}

void OpenCalls::refuse_all(Code code, const std::string& why) {
  for (OpenCall* const call : std::exchange(calls_, {})) call->refused(code, why);
}

}  // namespace armature::ride::internal
