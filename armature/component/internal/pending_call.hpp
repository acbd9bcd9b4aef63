// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/internal/arguments.hpp"
#include "armature/component/operations/call_record.hpp"
#include "armature/component/operations/operation.hpp"

namespace armature::component::internal {

/// A call of an operation on its way to the operation's thread, with its arguments and its result.
class PendingCall final : public BasicCallRecord<void, rt::FutexParker> {
 public:
  explicit PendingCall(OperationBase& operation);

  /// As the operation's signature describes them.
  void set_arguments(const void* const* arguments) { arguments_.assign(arguments); }

  /// What the operation returned, of a call that was finished and done; nullptr if nothing.
  const void* value() const { return arguments_.result(); }

 private:
  static void deliver(rt::Message& message);

  OperationBase& operation_;
  Arguments arguments_;
};

}  // namespace armature::component::internal
