// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/types/type.hpp"

namespace armature::remote::internal {

/// What another process says, without characters that would move a terminal's cursor.
std::string harmless(std::string_view text);

/// The same for all texts in a value.
void make_harmless(const types::Type& type, void* value);

template <typename T>
void make_harmless(T& value) {
  make_harmless(types::type_of<T>(), &value);
}

}  // namespace armature::remote::internal
