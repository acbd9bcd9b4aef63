// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

#include "armature/base/time.hpp"
#include "armature/component/properties/property.hpp"

namespace armature::component {

/// What only the operator can know, "the arm is at home", and what counts once: he sets it to true,
/// by `--set` for the run that begins or while it runs; the component that needed it takes it. No
/// file gives it, no script and no other process without a grant. A word that nobody took within
/// kLasts is void, and so is one that its component withdraws since it may not be so any more.
///
///     component::OperatorsWord at_home_{this, "at_home", "the operator has put the arm at home"};
///     ...
///     if (!at_home_.take()) return component::refused("put the arm at home, then set at_home =
///     true");
class OperatorsWord final : public Property<bool> {
 public:
  static constexpr base::Duration kLasts = std::chrono::minutes(10);

  OperatorsWord(Component* owner, std::string_view name, std::string_view doc) noexcept;

  /// It was said, and counts still.
  /// @rt nonblocking, no allocation
  /// @thread the component's own, as for all
  bool said() const;
  /// When it was said; unknown of a `--set`, which counts for the first who asks.
  std::optional<base::Time> said_at() const { return said_at_; }
  /// Uses it up.
  /// @return whether it was said
  bool take();
  /// It may not be so any more.
  void withdraw();

  void swap(types::Value& value) override;

 private:
  std::optional<base::Time> said_at_;
};

}  // namespace armature::component
