// SPDX-License-Identifier: Apache-2.0
#include "armature/component/described.hpp"

#include <utility>

#include "armature/component/internal/small_type.hpp"

namespace armature::component {
namespace {

PortDeclaration declaration_of(const DescribedPort& port) {
  return {port.name, port.doc, port.unit, port.type, internal::is_small_type(port.type)};
}

}  // namespace

DescribedOperation::DescribedOperation(Component& owner, std::string_view name,
                                       std::string_view doc, Signature signature) noexcept
    : OperationBase(owner, name, doc, std::move(signature), &execute_from) {
  apply(in_own_thread);
}

CallStatus DescribedOperation::execute_from(OperationBase& operation, ExecutionContext& where,
                                            const void* const* arguments, void* result) noexcept {
  if (!operation.is_elsewhere()) return CallStatus::kNotReady;  // of a component that never runs
  return static_cast<DescribedOperation&>(operation).pass_on(where, arguments, result);
}

std::unique_ptr<OperationBase> DescribedOperation::make_twin(Component& owner) const {
  return std::make_unique<DescribedOperation>(owner, name(), doc(), signature());
}

DescribedCommand::DescribedCommand(Component& owner, std::string_view name, std::string_view doc,
                                   Signature signature) noexcept
    : CommandBase(owner, name, doc, std::move(signature), [](CommandBase&, const void* const*) {
        return refused("its component is a description, and never runs");
      }) {}

DescribedInput::DescribedInput(Component& owner, const DescribedPort& port) noexcept
    : InputPortBase(owner, declaration_of(port)) {}

DescribedOutput::DescribedOutput(Component& owner, const DescribedPort& port) noexcept
    : OwnSample{internal::AnySample(internal::SampleForm(port.type))},
      OutputPortBase(owner, declaration_of(port), own.get()) {}

}  // namespace armature::component
