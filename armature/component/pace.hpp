// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/time.hpp"

namespace armature::component {

class Component;

/// How often a component is run, and who determines that: itself if it is periodic, else who
/// triggers it, through any chain of events and data, else who calls it.
struct Pace {
  base::Duration period{};           ///< 0: nobody periodic reaches it
  const Component* owner = nullptr;  ///< whose activity has this period
  base::Duration other{};            ///< of another one, which differs; 0: there is none
  const Component* other_owner = nullptr;

  bool known() const { return owner != nullptr && other_owner == nullptr; }
  bool ambiguous() const { return other_owner != nullptr; }
  bool operator==(const Pace&) const = default;
};

}  // namespace armature::component
