// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/mcap_format.hpp"

#include <zlib.h>

namespace armature::record::internal::mcap {

std::uint32_t crc32(std::uint32_t crc, std::string_view bytes) {
  const auto* const from = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(::crc32_z(crc, from, bytes.size()));
}

}  // namespace armature::record::internal::mcap
