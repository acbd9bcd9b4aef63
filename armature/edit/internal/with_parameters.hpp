// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/document/document.hpp"

namespace armature::edit::internal {

/// `${name}` replaced by the values of parameters, as far as there is one of that name.
std::string with_parameters(std::string text, const std::vector<document::Property>& parameters);

}  // namespace armature::edit::internal
