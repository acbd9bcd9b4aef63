// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/base/result.hpp"
#include "armature/edit/edit.hpp"

namespace armature::edit {

/// Writes what edits make of files: all, or after an error none. Each is replaced as a whole and
/// keeps its permissions; one that was empty need not be there yet. A file that is another one than
/// when it was read is left alone.
base::Result<void> save_files(const std::vector<FileChange>& files);

}  // namespace armature::edit
