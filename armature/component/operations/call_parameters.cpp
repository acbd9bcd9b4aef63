// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/call_parameters.hpp"

#include <utility>

#include "armature/types/elements.hpp"

namespace armature::component {
namespace {

/// nullptr: a constant, which was made as the parameter takes it.
const types::Type* offered_type(const CallParameter& parameter, const Signature* event) {
  if (parameter.from == CallParameter::From::kPort) return &parameter.port->type();
  if (parameter.from == CallParameter::From::kConstant) return nullptr;
  return event->arguments[parameter.member].type;
}

}  // namespace

CallParameters::CallParameters(Component& owner, const Signature& called, const Signature* event,
                               std::vector<CallParameter> parameters)
    : event_(event), parameters_(std::move(parameters)), places_(parameters_.size()) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CallParameter& parameter = parameters_[i];
    const types::Type& wanted = *called.arguments[i].type;
    const types::Type* const offered = offered_type(parameter, event);
    const bool same = offered == nullptr || types::same_type(*offered, wanted);
    conversions_.push_back({same ? nullptr : offered, types::Value(wanted)});
    auto& input = inputs_.emplace_back();
    if (parameter.from != CallParameter::From::kPort) continue;
    input = std::make_unique<UntypedInputPort>(owner, parameter.input,
                                               "a parameter of what is called", *parameter.port);
  }
}

bool CallParameters::takes(const types::Type& parameter, const types::Type& offered) {
  const bool floating =
      parameter.kind == types::Kind::kFloat || parameter.kind == types::Kind::kDouble;
  return types::same_type(parameter, offered) || (floating && types::is_number(offered));
}

const void* CallParameters::as_taken(std::size_t index, const void* from) {
  auto& [type, value] = conversions_[index];
  if (type == nullptr) return from;
  types::convert_number(*type, from, value.type(), value.data());
  return value.data();
}

std::vector<types::Value> CallParameters::sample_members() const {
  std::vector<types::Value> members;
  if (event_ == nullptr) return members;
  for (const auto& argument : event_->arguments) members.emplace_back(*argument.type);
  return members;
}

void CallParameters::fill_sample(const std::vector<types::Value>& members) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CallParameter& parameter = parameters_[i];
    switch (parameter.from) {
      case CallParameter::From::kMember:
        places_[i] = as_taken(i, members[parameter.member].data());
        break;
      case CallParameter::From::kPort:
        places_[i] = as_taken(i, inputs_[i]->current());
        break;
      case CallParameter::From::kConstant:
        places_[i] = parameter.constant->data();
        break;
    }
  }
}

Reason CallParameters::collect(const void* const* members, base::Time now, base::Duration max_age) {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const CallParameter& parameter = parameters_[i];
    if (parameter.from == CallParameter::From::kConstant) places_[i] = parameter.constant->data();
    if (parameter.from == CallParameter::From::kMember) {
      places_[i] = as_taken(i, members[parameter.member]);
    }
    if (parameter.from != CallParameter::From::kPort) continue;
    const auto read = inputs_[i]->read();
    Reason why(parameter.input);
    if (read.status < ReadStatus::kOld) return why.append(" was never written");
    if (max_age > base::Duration::zero() && now - read.time > max_age) {
      return why.append(" is too old");
    }
    places_[i] = as_taken(i, read.value);
  }
  return {};
}

}  // namespace armature::component
