// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/interface_numbers.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/remote/value_codec.hpp"

namespace armature::remote {
namespace {

using component::Signature;

/// Commands and their ends go before samples, and in the order in which they are given.
constexpr ride::Priority kOfCommands{255};

bool can_travel(const Signature& signature) {
  if (signature.result != nullptr && !remote::can_travel(*signature.result)) return false;
  return std::ranges::all_of(signature.arguments, [](const Signature::Argument& argument) {
    return remote::can_travel(*argument.type);
  });
}

std::string types_of(const Signature& signature) {
  std::string text;
  for (const Signature::Argument& argument : signature.arguments) {
    if (!text.empty()) text += ",";
    text += canonical(*argument.type);
  }
  return text;
}

}  // namespace

InterfaceNumbers::InterfaceNumbers(std::string model, const component::Interface& interface)
    : model_(std::move(model)) {
  using ride::Access;
  for (std::size_t i = 0; i < interface.operations.size(); ++i) {
    const component::OperationBase& operation = *interface.operations[i];
    if (!can_travel(operation.signature())) continue;
    const std::string name(operation.name());
    const types::Type* const result = operation.signature().result;
    const std::string whole = (result == nullptr ? "void" : canonical(*result)) + " " + name + "(" +
                              types_of(operation.signature()) + ")";
    if (!operation.is_command()) {
      add(whole, NumberedMember::Kind::kOperation, i, Access::kCommand);
      continue;
    }
    add(whole, NumberedMember::Kind::kCommand, i, Access::kCommand, kOfCommands);
    add("void cancel_" + name + "()", NumberedMember::Kind::kCancel, i, Access::kCommand,
        kOfCommands);
    add("event " + name + "_progress{double}", NumberedMember::Kind::kProgress, i, Access::kRead);
  }
  for (std::size_t i = 0; i < interface.events.size(); ++i) {
    const component::EventBase& event = *interface.events[i];
    if (!can_travel(event.signature())) continue;
    add("event " + std::string(event.name()) + "{" + types_of(event.signature()) + "}",
        NumberedMember::Kind::kEvent, i, Access::kRead);
  }
  for (std::size_t i = 0; i < interface.outputs.size(); ++i) {
    const component::OutputPortBase& port = *interface.outputs[i];
    if (!remote::can_travel(port.type())) continue;
    add("event " + port.name() + "{unsigned long,long," + canonical(port.type()) + "}",
        NumberedMember::Kind::kOutput, i, Access::kRead);
  }
  for (std::size_t i = 0; i < interface.inputs.size(); ++i) {
    const component::InputPortBase& port = *interface.inputs[i];
    if (!remote::can_travel(port.type())) continue;
    add("void " + port.name() + "(" + canonical(port.type()) + ")", NumberedMember::Kind::kInput, i,
        Access::kCommand);
  }
  refer_to_texts();
}

InterfaceNumbers::InterfaceNumbers(std::string name, const std::vector<DescribedDeclaration>& all)
    : model_(std::move(name)) {
  for (const DescribedDeclaration& each : all) {
    texts_.push_back(each.canonical);
    declarations_.push_back({{}, each.access});
    if (!each.member) continue;
    members_.push_back(*each.member);
    members_.back().number = ride::number_of(each.canonical);
  }
  refer_to_texts();
}

void InterfaceNumbers::refer_to_texts() {
  for (std::size_t i = 0; i < texts_.size(); ++i) declarations_[i].canonical = texts_[i];
  interface_ = {model_, declarations_};
}

void InterfaceNumbers::add(std::string canonical, NumberedMember::Kind kind, std::size_t index,
                           ride::Access access, ride::Priority priority) {
  members_.push_back({ride::number_of(canonical), kind, index, priority, {}});
  texts_.push_back(std::move(canonical));
  declarations_.push_back({{}, access});
}

const NumberedMember* InterfaceNumbers::find(ride::Number number) const {
  const auto found = std::ranges::find(members_, number, &NumberedMember::number);
  return found == members_.end() ? nullptr : &*found;
}

const NumberedMember* InterfaceNumbers::member(NumberedMember::Kind kind, std::size_t index) const {
  const auto found = std::ranges::find_if(members_, [&](const NumberedMember& member) {
    return member.kind == kind && member.index == index;
  });
  return found == members_.end() ? nullptr : &*found;
}

ride::Number InterfaceNumbers::number(NumberedMember::Kind kind, std::size_t index) const {
  const NumberedMember* const found = member(kind, index);
  return found == nullptr ? 0 : found->number;
}

}  // namespace armature::remote
