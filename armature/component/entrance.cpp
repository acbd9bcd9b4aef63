// SPDX-License-Identifier: Apache-2.0
#include "armature/component/entrance.hpp"

#include <array>
#include <cstddef>

#include "armature/component/internal/inside.hpp"

namespace armature::component {

namespace {

/// The first of `from` and those outside of it that is a handler.
const Entrance* handler_from(const Entrance* from) {
  while (from != nullptr && from->handler().empty()) from = from->outer();
  return from;
}

}  // namespace

void Entrance::refuse(ExecutionContext& where) const noexcept {
  std::array<const Entrance*, 8> way{this};
  std::size_t length = 1;
  const Entrance* each = handler_from(where.innermost.load(std::memory_order_relaxed));
  while (each != this && each != nullptr && length < way.size()) {
    way[length++] = each;
    each = handler_from(each->outer());
  }

  Reason why("a handler set itself off: ");
  why.append(component().name())
      .append(".")
      .append(handler())
      .append(each == this ? "" : " -> ...");
  while (length-- > 0) {
    why.append(" -> ")
        .append(way[length]->component().name())
        .append(".")
        .append(way[length]->handler());
  }
  internal::Inside::fault_from(component(), where, why);
}

}  // namespace armature::component
