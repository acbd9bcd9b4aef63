// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace armature::replay {

/// The content of a text file; nothing if it is larger, is no UTF-8, or is no file.
std::optional<std::string> small_text(const std::string& path, std::size_t limit_bytes);

}  // namespace armature::replay
