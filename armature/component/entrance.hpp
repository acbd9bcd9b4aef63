// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/component/context.hpp"

namespace armature::component {

/// The way into a handler of a component. While the handler runs it may set off others, but not,
/// through them, itself: that would have no end, and faults its component with the way it took.
class Entrance {
 public:
  /// @param name  of the port or event, living as long as the component
  Entrance(Component& component, std::string_view name) : component_(component), name_(name) {}

  /// Runs `code`, which throws nothing, unless it runs already.
  /// @rt as the code is
  /// @thread that of `where`
  template <typename Code>
  void pass(ExecutionContext& where, Code&& code) {
    if (inside_) [[unlikely]] {
      refuse(where);
      return;
    }
    inside_ = true;
    outer_ = where.innermost;
    where.innermost = this;
    code();
    where.innermost = outer_;
    inside_ = false;
  }

 private:
  void refuse(ExecutionContext& where) const;

  Component& component_;
  std::string_view name_;
  const Entrance* outer_ = nullptr;
  bool inside_ = false;
};

}  // namespace armature::component
