// SPDX-License-Identifier: Apache-2.0
#pragma once

// Members of a component that is known by a description only, such as an interface file. Such a
// component never runs: a StandIn has twins of these members, and passes on what comes to them.
// Names and documentation live as long as the members.
//
// @thread configuration only

#include <memory>
#include <string_view>

#include "armature/component/events/event.hpp"
#include "armature/component/internal/sample_form.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::component {

/// An operation of any signature.
class DescribedOperation final : public OperationBase {
 public:
  DescribedOperation(Component& owner, std::string_view name, std::string_view doc,
                     Signature signature) noexcept;

 private:
  static CallStatus execute_from(OperationBase& operation, ExecutionContext& where,
                                 const void* const* arguments, void* result) noexcept;
  std::unique_ptr<OperationBase> make_twin(Component& owner) const override;
};

/// A command of any signature.
class DescribedCommand final : public CommandBase {
 public:
  DescribedCommand(Component& owner, std::string_view name, std::string_view doc,
                   Signature signature) noexcept;
};

/// An event of any signature whose arguments have a fixed size.
class DescribedEvent final : public EventBase {
 public:
  DescribedEvent(Component& owner, std::string_view name, std::string_view doc,
                 Signature signature) noexcept
      : EventBase(owner, name, doc, std::move(signature)) {}
};

/// What a port that is described is made of.
struct DescribedPort {
  std::string_view name;
  std::string_view doc;
  std::string_view unit;
  const types::Type& type;
};

/// An input of any type that has no text inside.
class DescribedInput final : public InputPortBase {
 public:
  DescribedInput(Component& owner, const DescribedPort& port) noexcept;
};

namespace internal {

/// Goes before the port whose sample it holds.
struct OwnSample {
  AnySample own;
};

}  // namespace internal

/// An output of any type of fixed size.
class DescribedOutput final : private internal::OwnSample, public OutputPortBase {
 public:
  DescribedOutput(Component& owner, const DescribedPort& port) noexcept;
};

}  // namespace armature::component
