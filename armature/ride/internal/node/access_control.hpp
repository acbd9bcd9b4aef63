// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "armature/ride/node.hpp"

namespace armature::ride::internal {

/// Who may do what at a node: as its owner says, or everyone everything.
/// @thread any
class AccessControl {
 public:
  explicit AccessControl(const std::function<bool(const AccessQuestion&)>& allows)
      : allows_(allows) {}

  /// False if everyone may do everything.
  bool asks() const { return allows_ != nullptr; }
  bool allows(const AccessQuestion& question) const { return !allows_ || allows_(question); }

 private:
  const std::function<bool(const AccessQuestion&)>& allows_;
};

/// `operator@tls may not command 'Vision'`.
std::string not_allowed(const AccessQuestion& question);

}  // namespace armature::ride::internal
