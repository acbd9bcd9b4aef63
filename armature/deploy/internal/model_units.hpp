// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/registry.hpp"

namespace armature::deploy::internal {

/// Units that `component`, one of `model`, declares and that there are not: one text for each
/// member of its interface, which names library, model, member and unit and says what was meant.
std::vector<std::string> unit_mistakes(const component::Component& component,
                                       const component::Registry::Model& model);

}  // namespace armature::deploy::internal
