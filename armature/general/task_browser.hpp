// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"

namespace armature::general {

/// Stands in a deployment for the operator's prompt (paper 2, section 4.2.1; paper 1, table 1):
/// `armature run` opens the prompt at its terminal for it, as `--browse` does. It does nothing
/// itself, and needs no peers: the prompt reaches all components.
class TaskBrowser final : public component::Component {
 public:
  using Component::Component;
};

}  // namespace armature::general
