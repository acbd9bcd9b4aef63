// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::platform {

/// The whole content of a file; the error names the file and the system's reason. Refuses
/// directories and files above `limit_bytes`.
base::Result<std::string> read_file(const std::string& path, std::size_t limit_bytes = 64u << 20);

/// Replaces a file as a whole: after a failure or a crash it holds either the old or the new
/// content. Follows links, keeps the permissions; a device or a pipe is written to, not replaced.
base::Result<void> write_file(const std::string& path, std::string_view content);

}  // namespace armature::platform
