// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace armature::component {

/// Something a component does around its update hook: a state machine, a command under way.
class Step {
 public:
  virtual void step() = 0;
  /// The component was stopped or faulted: what was under way is over.
  virtual void halt(std::string_view reason) = 0;
  virtual void start() {}

 protected:
  ~Step() = default;
};

}  // namespace armature::component
