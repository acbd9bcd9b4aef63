// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/language.hpp"
#include "armature/browser/internal/spelled_view.hpp"

namespace armature::browser::internal {

/// What may stand where the cursor is.
struct Completion {
  std::size_t begin = 0;  ///< of the word that they complete, in the text before the cursor
  std::vector<std::string> words;  ///< whole, in order

  /// What all of them begin with.
  std::string common() const;
};

Completion complete(SpelledView& view, Language& language, std::string_view before_cursor);

}  // namespace armature::browser::internal
