// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/edit/edit.hpp"

namespace armature::edit {

/// What becomes of a file as `diff -u` shows it, with three lines around each change.
std::string unified_diff(const FileChange& change);

}  // namespace armature::edit
