// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/document.hpp"
#include "armature/deploy/document_files.hpp"

namespace armature::deploy::internal {

/// An OROCOS deployer file as the tree that a YAML file of the same application has; all texts are
/// literal. What OROCOS has and we have not is reported.
Value parse_xml(std::string_view text, const std::string& file, const Limits& limits,
                base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
