// SPDX-License-Identifier: Apache-2.0
#include "armature/general/controls/named_call.hpp"

#include <utility>

namespace armature::general {

using component::CallStatus;
using component::CommandStage;

NamedCall::NamedCall(component::Component& owner, Listener& listener, component::NamedCall call)
    : owner_(owner),
      listener_(listener),
      caller_name_(std::move(call.caller)),
      called_(std::move(call.called)),
      operation_(*call.operation),
      parameters_(owner, operation_.signature(), nullptr, std::move(call.parameters)) {
  if (operation_.is_command()) {
    command_caller_ = std::make_unique<component::UntypedCommandCaller>(
        owner, caller_name_, "what is commanded",
        static_cast<const component::CommandBase&>(operation_), kMost,
        [](void* self, CommandStage stage, std::string_view reason) {
          static_cast<NamedCall*>(self)->ended(stage, reason);
        },
        this);
  } else {
    operation_caller_ = std::make_unique<component::UntypedOperationCaller>(
        owner, caller_name_, "what is called", operation_, kMost,
        [](void* self, CallStatus status, const void* result) {
          static_cast<NamedCall*>(self)->answered(status, result);
        },
        this);
  }
}

void NamedCall::prepare() {
  parameters_.with_sample([this](const void* const* sample) {
    if (command_caller_) command_caller_->prepare(sample);
    if (operation_caller_) operation_caller_->prepare(sample);
  });
}

void NamedCall::begin() {
  const component::Reason missing =
      parameters_.collect(nullptr, owner_.time(), base::Duration::zero());
  if (!missing.empty()) return listener_.call_failed(missing);
  const CallStatus status = send();
  if (status != CallStatus::kPending) listener_.call_failed(name_of(status));
}

CallStatus NamedCall::send() {
  if (command_caller_) return command_caller_->send(parameters_.places());
  return operation_caller_->send(parameters_.places());
}

void NamedCall::call_off() {
  if (operation_caller_) operation_caller_->forget();
  if (!command_caller_) return;
  command_caller_->rest();
  command_caller_->forget();
  command_caller_->resume();
}

void NamedCall::answered(CallStatus status, const void* result) {
  if (status == CallStatus::kDone) return listener_.call_done(result);
  listener_.call_failed(name_of(status));
}

void NamedCall::ended(CommandStage stage, std::string_view reason) {
  if (stage == CommandStage::kDone) return listener_.call_done(nullptr);
  listener_.call_failed(reason.empty() ? name_of(stage) : reason);
}

}  // namespace armature::general
