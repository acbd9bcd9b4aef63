// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/check.hpp"

namespace armature::ros2::internal {

/// Refuses a wiring in which what comes from ROS 2 becomes an effort without passing a component
/// that takes commands, such as a generator of motions or a chassis, which keeps the limits.
void check_efforts(const component::Component& from, component::Check& check);

/// The same of what is written to an input.
void check_efforts_behind(const component::InputPortBase& input, component::Check& check);

}  // namespace armature::ros2::internal
