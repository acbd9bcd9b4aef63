// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"
#include "armature/cli/new_folder.hpp"

namespace armature::cli {

/// Writes a component library that builds, with a component, its test, a deployment and a README,
/// into a new folder below `parent`. `name` is the component's: `GripperDriver` or
/// `gripper_driver`. Refused, with nothing written, for a name that is no C++ identifier or a
/// folder that exists.
base::Result<NewFolder> make_component_library(const std::string& name, const std::string& parent);

}  // namespace armature::cli
