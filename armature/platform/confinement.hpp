// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"

namespace armature::platform {

/// From now on this process makes and changes files in `folder` alone, and reads whatever it likes.
/// Two walls: `write_file`, `expect_writable` and OutputFile refuse other paths with a message that
/// says why, and on kernels with Landlock (Linux 5.13) the kernel refuses them to all code,
/// whatever library it is of. Terminals and /dev/null stay open. There is no way back.
/// @param folder  that exists
/// @return the error says that the folder is none; a kernel without Landlock is none
/// @thread the controlling one, before it makes others: the kernel's wall is that of its threads
base::Result<void> write_only_in(const std::string& folder);

/// Whether `path` is `folder` or in it, by whatever names and links; false if that cannot be found.
bool lies_in(const std::string& path, const std::string& folder);

/// The error says that `path` lies outside of the folder to which writing is confined.
base::Result<void> expect_inside(const std::string& path);

}  // namespace armature::platform
