// SPDX-License-Identifier: Apache-2.0
#include "armature/base/text_table.hpp"

#include <algorithm>
#include <cstddef>

#include "armature/base/utf8.hpp"

namespace armature::base {

std::string table_text(const std::vector<Row>& rows, std::string_view indent) {
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], character_count(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line(indent);
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (widths[i] > 0) line.append(widths[i] - character_count(row[i]) + 2, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace armature::base
