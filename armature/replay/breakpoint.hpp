// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/exec/application.hpp"
#include "armature/inspect/items.hpp"

namespace armature::replay {

/// A condition on a number of an application in simulated time: `Joint1.Position > 0.3`.
/// @thread the controlling one
class Breakpoint {
 public:
  /// @param text  an item that is one number, one of `> < >= <= == !=`, a number with or without a
  ///              unit; the error says which part is wrong
  static base::Result<Breakpoint> parse(exec::Application& application, const std::string& text);

  /// What made it true just now, `Joint1.Position = 0.3001 rad`; nothing while it stays as it was.
  std::optional<std::string> look();

  const std::string& text() const { return text_; }

 private:
  enum class Is { kAbove, kBelow, kAtLeast, kAtMost, kEqual, kUnequal };

  Breakpoint(std::string text, inspect::WatchedPlace place, Is is, double bound)
      : text_(std::move(text)), place_(std::move(place)), is_(is), bound_(bound) {}
  static base::Result<Breakpoint> make(exec::Application& application, const std::string& text,
                                       std::string_view item, Is is, std::string_view bound);
  bool holds(double value) const;

  std::string text_;
  inspect::WatchedPlace place_;
  Is is_;
  double bound_;
  bool held_ = false;
};

}  // namespace armature::replay
