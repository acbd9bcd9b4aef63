// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the task browser explains.

#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/browser/internal/vocabulary.hpp"

namespace armature::browser::internal {

/// What there is to type.
std::string help_overview(const Paper& paper, const Vocabulary& vocabulary);

/// Help on a command, a function, a component or a member of one; a mistake says what is near.
base::Result<std::string> help_on(const Paper& paper, SpelledView& view,
                                  const Vocabulary& vocabulary, std::string_view subject);

}  // namespace armature::browser::internal
