// SPDX-License-Identifier: Apache-2.0
#include "armature/component/entrance.hpp"

#include <array>
#include <cstddef>

#include "armature/component/component.hpp"

namespace armature::component {

void Entrance::refuse(ExecutionContext& where) const {
  std::array<const Entrance*, 8> way{this};
  std::size_t length = 1;
  const Entrance* each = where.innermost;
  for (; each != this && length < way.size(); each = each->outer_) way[length++] = each;

  Reason why("a handler set itself off: ");
  why.append(component_.name()).append(".").append(name_).append(each == this ? "" : " -> ...");
  while (length-- > 0) {
    why.append(" -> ")
        .append(way[length]->component_.name())
        .append(".")
        .append(way[length]->name_);
  }
  component_.fault_from(where, why);
}

}  // namespace armature::component
