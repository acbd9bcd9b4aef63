// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/types/type.hpp"

namespace armature::exec {

/// The component that writes what the operator gives the inputs that a deployment opens for him.
inline constexpr const char* kOperatorName = "operator";

/// Writes inputs with values that come from outside the application: of other processes
/// (`network: {inputs: ...}`), or of the operator (`operator_inputs`, paper 2, section 4.2.1). Each
/// of its outputs is called as the input with its component.
class Inlets final : public component::Component {
 public:
  Inlets(std::string name, const std::vector<component::InputPortBase*>& inputs);

  bool writes(const component::InputPortBase& input) const;

  /// `input` is one that it writes. The error says what is wrong with the value.
  /// @thread the controlling one
  base::Result<void> write(Application& application, const component::InputPortBase& input,
                           const types::Value& value);

 private:
  struct Inlet {
    const component::InputPortBase* input;
    std::unique_ptr<component::OutputPortBase> writer;
  };
  std::vector<Inlet> inlets_;
};

/// Writes an input for the operator. The error names an input that is not open, or says what is
/// wrong with the value.
/// @thread the controlling one
base::Result<void> write_for_operator(Application& application,
                                      const component::InputPortBase& input,
                                      const types::Value& value);

/// Whether `write_for_operator` can write it.
bool is_open_to_operator(const Application& application, const component::InputPortBase& input);

}  // namespace armature::exec
