// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"

/// Values as messages of ROS 2: bytes in CDR, and the text of their definitions (`ros2msg`). A
/// struct is itself a message, any other value the member `data` of one. Enumerations are their
/// numbers, with constants beside them; a list of lists is a list of messages with the member
/// `data`.
namespace armature::record {

/// Little-endian, with the four bytes before it that say so.
std::string to_cdr(const types::Type& type, const void* value);

/// What `to_cdr` writes as json.hpp has it.
/// @param layout  types::layout_text of the type
/// @return the error says at which byte what was expected, or that the layout is none
base::Result<std::string> json_of_cdr(std::string_view layout, std::string_view cdr);

/// `armature_msgs/msg/Pose`, `std_msgs/msg/Float64`; of what ROS has itself (ros_types.hpp) that.
std::string ros2_name(const types::Type& type);

/// The definition of the message, and of those that are in it. Names of fields are in lower case.
std::string ros2_definition(const types::Type& type);

}  // namespace armature::record
