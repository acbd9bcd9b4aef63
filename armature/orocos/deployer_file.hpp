// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"

namespace armature::orocos {

/// An OROCOS deployer file as the tree that a YAML file of the same application has; all texts are
/// literal. What OROCOS has and we have not is reported.
document::Value parse_xml(std::string_view text, const std::string& file,
                          const document::Limits& limits, base::Diagnostics& diagnostics);

/// The document as an OROCOS deployer file. What OROCOS has no word for is written in attributes
/// `armature:...`, which OROCOS ignores; a note for each such thing says so.
std::string write_xml(const document::Document& document, base::Diagnostics& diagnostics);

}  // namespace armature::orocos
