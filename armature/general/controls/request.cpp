// SPDX-License-Identifier: Apache-2.0
#include "armature/general/controls/request.hpp"

#include <utility>

namespace armature::general {

component::Outcome Request::declare_calls(std::vector<component::NamedCall> calls) {
  component::NamedCall& call = calls.front();
  const types::Type* const result = call.operation->signature().result;
  component::Signature members;
  if (call.operation->is_command()) {
    return component::refused(component::Reason(call.called)
                                  .append(" is a command, which answers nothing: give it by an "
                                          "event, or in a Sequence"));
  }
  if (result != nullptr && (!result->fixed_size() || result->sealed)) {
    return component::refused(component::Reason(call.called)
                                  .append(" returns ")
                                  .append(result->name)
                                  .append(", which no port takes here: a Request takes results of "
                                          "fixed size"));
  }
  if (result != nullptr) {
    members.arguments.push_back({"result", result, false});
    const component::DescribedPort port{"Result", "what was answered last", unit_.get(), *result};
    result_ = std::make_unique<component::DescribedOutput>(*this, port);
  }
  answered_ = std::make_unique<component::DescribedEvent>(*this, "Answered", "the answer is there",
                                                          std::move(members));
  NamedCall::Listener& listener = *this;
  question_ = std::make_unique<NamedCall>(*this, listener, std::move(call));
  return component::accepted();
}

component::Outcome Request::on_activate() {
  question_->prepare();
  return component::accepted();
}

component::Outcome Request::begin() {
  if (state() != component::State::kRunning) return component::refused("it does not run");
  question_->begin();
  return component::accepted();
}

void Request::call_done(const void* result) {
  if (result_) result_->write_from(result);
  ask_.complete();
  answered_->raise_from(&result);
}

void Request::call_failed(std::string_view why) {
  component::Reason reason(question_->called());
  reason.append(": ").append(why);
  ask_.fail(reason.view());
  failed_.raise(NamedCall::Why(reason.view()));
}

}  // namespace armature::general
