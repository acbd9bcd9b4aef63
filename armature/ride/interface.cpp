// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/interface.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace armature::ride {

std::string_view name_of(Access access) {
  switch (access) {
    case Access::kRead:
      return "read";
    case Access::kCommand:
      return "command";
    case Access::kConfigure:
      return "configure";
  }
  return "nothing";
}

std::uint32_t digest(const Interface& interface) {
  std::vector<std::string_view> sorted;
  for (const Declaration& declaration : interface.declarations) {
    sorted.push_back(declaration.canonical);
  }
  std::ranges::sort(sorted);
  std::string all;
  for (const std::string_view canonical : sorted) {
    if (!all.empty()) all += ';';
    all += canonical;
  }
  return base::fnv1a(all);
}

}  // namespace armature::ride
