// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_set>

#include "armature/component/component.hpp"
#include "armature/component/host.hpp"

namespace armature::exec::internal {

/// Components and threads in which something hangs: nobody else may touch them any more.
class Unreachable {
 public:
  void give_up(const component::Component& component) { stuck_.insert(&component); }
  void give_up(const component::ExecutionContext& thread) { stuck_.insert(&thread); }

  /// It hangs itself, or its thread does.
  bool includes(const component::Component& component) const {
    return stuck_.count(&component) > 0 || includes(component::Host::context(component));
  }
  bool includes(const component::ExecutionContext& thread) const {
    return stuck_.count(&thread) > 0;
  }
  bool any() const { return !stuck_.empty(); }

 private:
  std::unordered_set<const void*> stuck_;
};

}  // namespace armature::exec::internal
