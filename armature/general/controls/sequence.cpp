// SPDX-License-Identifier: Apache-2.0
#include "armature/general/controls/sequence.hpp"

#include <utility>

namespace armature::general {

component::Outcome Sequence::declare_calls(std::vector<component::NamedCall> calls) {
  for (component::NamedCall& call : calls) {
    NamedCall::Listener& listener = *this;
    steps_.push_back(std::make_unique<NamedCall>(*this, listener, std::move(call)));
  }
  return component::accepted();
}

component::Outcome Sequence::on_activate() {
  for (const auto& step : steps_) step->prepare();
  return component::accepted();
}

component::Outcome Sequence::begin() {
  if (state() != component::State::kRunning) return component::refused("it does not run");
  step_ = 0;
  call_.assign(1);
  steps_.front()->begin();
  return component::accepted();
}

void Sequence::call_done(const void* result) {
  const types::Type* const type = steps_[step_]->result();
  const bool tells = type != nullptr && type->kind == types::Kind::kBool;
  if (tells && !*static_cast<const bool*>(result)) return call_failed("it returned false");
  if (++step_ == steps_.size()) {
    step_ = 0;
    run_.complete();
    done_.raise();
    return;
  }
  call_.assign(static_cast<std::int32_t>(step_ + 1));
  run_.report(static_cast<double>(step_) / static_cast<double>(steps_.size()));
  steps_[step_]->begin();
}

void Sequence::call_failed(std::string_view why) {
  component::Reason reason(steps_[step_]->called());
  reason.append(": ").append(why);
  log_warning("call {}, {}", call_.get(), reason.view());
  const NamedCall::Why told(reason.view());
  why_.assign(told);
  run_.fail(reason.view());
  failed_.raise(call_, told);
}

}  // namespace armature::general
