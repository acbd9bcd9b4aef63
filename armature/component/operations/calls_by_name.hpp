// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "armature/component/operations/call_parameters.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/outcome.hpp"

namespace armature::component {

/// What a deployment has a component call: an operation or a command, with its parameters.
struct NamedCall {
  std::string caller;  ///< how the component names its use of it; the deployment binds that
  std::string called;  ///< `Component.operation`, for messages
  const OperationBase* operation = nullptr;
  std::vector<CallParameter> parameters;
};

/// A component that calls what its deployment names under `calls`, of any signature.
class CallsByName {
 public:
  /// So many it makes; one at least.
  virtual std::size_t most_calls() const = 0;
  /// Declares what it needs for them, once, when its properties have their values.
  /// @return refused: it cannot make one of them
  /// @thread configuration only
  virtual Outcome declare_calls(std::vector<NamedCall> calls) = 0;

 protected:
  ~CallsByName() = default;
};

}  // namespace armature::component
