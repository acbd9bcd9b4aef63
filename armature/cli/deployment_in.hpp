// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"

namespace armature::cli {

/// The one deployment in a folder or in its folder `deployments`; files that others only include
/// name no `application`. The error lists what there is to choose from, or says how to begin one.
base::Result<std::string> deployment_in(const std::string& folder);

}  // namespace armature::cli
