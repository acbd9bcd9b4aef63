// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::record::internal {

// Of chunks, by their names in MCAP files: `zstd`, `lz4` (frames), and nothing.

/// Whether this build can; the error says what it lacks, or which there are.
base::Result<void> can_compress(std::string_view compression);

/// @param compression  one that there is
std::string compressed(std::string_view compression, std::string_view bytes);

/// @param size  of what was compressed; of another size it is damaged
base::Result<std::string> decompressed(std::string_view compression, std::string_view bytes,
                                       std::size_t size);

}  // namespace armature::record::internal
