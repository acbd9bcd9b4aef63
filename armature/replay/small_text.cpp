// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/small_text.hpp"

#include <utility>

#include "armature/base/utf8.hpp"
#include "armature/platform/file.hpp"

namespace armature::replay {
std::optional<std::string> small_text(const std::string& path, std::size_t limit_bytes) {
  auto content = platform::read_file(path, limit_bytes);
  if (!content || !base::is_utf8(content.value())) return std::nullopt;
  return std::move(content).value();
}

}  // namespace armature::replay
