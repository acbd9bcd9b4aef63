// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/component/observing/observer.hpp"

namespace armature::ros2::internal {

/// Why a component must not work with DDS in the thread that it has; empty if it may.
/// @thread configuration only
std::string objection_to_thread(const component::Component& component,
                                const component::Surroundings& surroundings);

}  // namespace armature::ros2::internal
