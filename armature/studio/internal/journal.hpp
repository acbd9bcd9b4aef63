// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/studio/internal/project.hpp"

namespace armature::studio::internal {

/// What is not saved yet, in a file that a studio which was killed leaves to the next one.
class Journal {
 public:
  explicit Journal(std::string path) : path_(std::move(path)) {}

  /// What an earlier studio left; nothing if the file is none of a journal.
  Unsaved left() const;
  /// Replaces what is kept; nothing is kept of nothing. The error: it cannot be written.
  base::Result<void> keep(const Unsaved& unsaved) const;

 private:
  const std::string path_;
};

}  // namespace armature::studio::internal
