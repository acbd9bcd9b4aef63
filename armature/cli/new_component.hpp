// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::cli {

/// What `make_component_library` wrote.
struct NewComponent {
  std::string folder;
  std::vector<std::string> files;  ///< relative to the folder
};

/// Writes a component library that builds, with a component, its test, a deployment and a README,
/// into a new folder below `parent`. `name` is the component's: `GripperDriver` or
/// `gripper_driver`. Refused, with nothing written, for a name that is no C++ identifier or a
/// folder that exists.
base::Result<NewComponent> make_component_library(const std::string& name,
                                                  const std::string& parent);

}  // namespace armature::cli
