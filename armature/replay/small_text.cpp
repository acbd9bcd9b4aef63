// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/small_text.hpp"

#include <string_view>
#include <utility>

#include "armature/base/utf8.hpp"
#include "armature/platform/file.hpp"

namespace armature::replay {
namespace {

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto character = base::code_point_at(text, at);
    if (!character) return false;
    at = character->end;
  }
  return true;
}

}  // namespace

std::optional<std::string> small_text(const std::string& path, std::size_t limit_bytes) {
  auto content = platform::read_file(path, limit_bytes);
  if (!content || !is_utf8(content.value())) return std::nullopt;
  return std::move(content).value();
}

}  // namespace armature::replay
