// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/types/type.hpp"

namespace armature::remote {

/// Writes what other processes send to the inputs that a deployment opens for them
/// (`network: {inputs: ...}`).
class Inlets final : public component::Component {
 public:
  explicit Inlets(const std::vector<component::InputPortBase*>& inputs);

  /// Why `input` is not written by others.
  static base::Error not_open(const component::InputPortBase& input);

  /// The error names the input that is not open, or what is wrong with the value.
  /// @thread the controlling one
  base::Result<void> write(exec::Application& application, const component::InputPortBase& input,
                           const types::Value& value);

 private:
  struct Inlet {
    const component::InputPortBase* input;
    std::unique_ptr<component::OutputPortBase> writer;
  };
  std::vector<Inlet> inlets_;
};

}  // namespace armature::remote
