// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace armature::base {

using Row = std::vector<std::string>;

/// Rows of equally many texts as lines with aligned columns, each line begun with `indent`.
std::string table_text(const std::vector<Row>& rows, std::string_view indent = {});

}  // namespace armature::base
