// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"

namespace armature::orocos {

/// Reads an OROCOS property file (.cpf).
std::vector<document::Property> parse_cpf(std::string_view text, const std::string& name,
                                          base::Diagnostics& diagnostics,
                                          const document::Limits& limits = {});

/// Writes an OROCOS property file. Give each value the OROCOS `type` that its text does not show.
std::string write_cpf(const std::vector<document::Property>& properties);

}  // namespace armature::orocos
