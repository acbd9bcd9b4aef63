// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"

namespace armature::studio::internal {

/// The text of a robot's description (URDF), to be shown to whoever may look. Nothing else of the
/// machine is given away by it: the check has found a component that names the file as its robot's
/// description, and the file is one.
/// @param path      as the component's property has it
/// @param findings  of the check, JSON
/// @return the error says why it is not given
base::Result<std::string> read_description(const std::string& path, const std::string& findings);

}  // namespace armature::studio::internal
