// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/component/ports/output_port.hpp"

namespace armature::ros2::internal {

/// The port `Component.Port`; nullptr if there is none.
/// @thread configuration only
component::OutputPortBase* find_output(const std::vector<component::Component*>& components,
                                       const std::string& path);
component::InputPortBase* find_input(const std::vector<component::Component*>& components,
                                     const std::string& path);

}  // namespace armature::ros2::internal
