// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/operations/calls_by_name.hpp"
#include "armature/deploy/internal/parameter_builder.hpp"

namespace armature::deploy::internal {

/// Tells components what they call, by the key `calls`, and makes those whom they call their peers.
class CallBuilder {
 public:
  CallBuilder(const Document& document, exec::Blueprint& blueprint, base::Diagnostics& diagnostics);

  /// Once all components are there; before connections, which may begin at what it declares.
  void build();

 private:
  void add(const Component& written, exec::ComponentEntry& entry);
  bool check_number(const Component& written, const exec::ComponentEntry& entry,
                    const component::CallsByName* caller);
  /// The operation; nullptr if a mistake was told, or its component could not be made.
  const component::OperationBase* operation_of(const Component& written, const Call& call);
  std::optional<component::NamedCall> named(const Component& written, const Call& call,
                                            std::size_t index);

  const Document& document_;
  exec::Blueprint& blueprint_;
  base::Diagnostics& diagnostics_;
  Components components_;
};

}  // namespace armature::deploy::internal
