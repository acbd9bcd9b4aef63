// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/answers.hpp"

#include <string>

namespace armature::browser::internal {

void Answers::mistake(std::string_view text) {
  const std::string error = "error: " + std::string(text);
  surface_.complain(surface_.live() ? wrapped(paper(), error, 0, 0) : error);
  ++mistakes_;
}

}  // namespace armature::browser::internal
