// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/registry.hpp"

namespace armature::inspect {

/// What is wrong with the interface of `component`, one of `model`: units that there are not, ports
/// whose data grows. One text for each member, which names library, model and member.
std::vector<std::string> mistakes_of_model(const component::Component& component,
                                           const component::Registry::Model& model);

}  // namespace armature::inspect
