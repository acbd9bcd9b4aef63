// SPDX-License-Identifier: Apache-2.0
#include "idl/internal/structure_order.hpp"

#include <algorithm>
#include <functional>

namespace armature::idl::internal {

std::vector<const Structure*> in_order_of_use(const Program& program) {
  std::vector<const Structure*> ordered;
  const std::function<void(const Structure&)> add = [&](const Structure& structure) {
    const bool done = std::find(ordered.begin(), ordered.end(), &structure) != ordered.end();
    if (done || structure.module != program.main().name) return;
    for (const Field& member : structure.members) {
      if (member.type.basic == Basic::kStruct) add(*program.find_struct(member.type.name));
    }
    ordered.push_back(&structure);
  };
  for (const Structure& structure : program.main().structures) add(structure);
  return ordered;
}

}  // namespace armature::idl::internal
