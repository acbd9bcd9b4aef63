// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/component/check.hpp"

namespace armature::ros2::internal {

/// Who brakes `component` when the operator stops the robot; nullptr: nobody.
const component::Component* brakes(const component::Component& component,
                                   const component::Check& check);

/// Follows what comes from ROS 2 along connections, calls and events, and refuses a wiring in which
/// it becomes an effort, or what a joint's limiter lets through. It ends at a component that keeps
/// limits: one that takes commands of motions and brakes at the operator's stop, such as a
/// generator or a chassis. Commands of the operator alone do not count, such as a joint's `home`.
/// @param from   whose outputs, calls and events are followed
/// @param input  that `from` writes beside that; nullptr: none
/// @return the components that keep limits which it came to
std::vector<const component::Component*> check_reach(const component::Component& from,
                                                     const component::InputPortBase* input,
                                                     component::Check& check);

}  // namespace armature::ros2::internal
