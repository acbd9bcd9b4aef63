// SPDX-License-Identifier: Apache-2.0
#pragma once

// What rcidl's output says of enumerations: `enum Mode { off, on };` in the interface language.

#include <string>
#include <type_traits>

#include "armature/ride/codec.hpp"
#include "armature/types/enum.hpp"

namespace armature::ride {

template <typename E>
bool Decoder::take_enumerator(E& value) {
  std::underlying_type_t<E> number{};
  if (!take(number)) return false;
  const types::Type& type = types::type_of<E>();
  const E found = static_cast<E>(number);
  if (!types::is_enumerator(type, &found)) {
    problem_ =
        type.name + " is " + std::to_string(number) + ", expected " + types::enumerator_list(type);
    return fail();
  }
  value = found;
  return true;
}

}  // namespace armature::ride
