// SPDX-License-Identifier: Apache-2.0
#include "armature/base/as_reason.hpp"

namespace armature::base {

std::string as_reason(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& one : diagnostics.all()) {
    if (one.severity != Severity::kError) continue;
    text += (text.empty() ? "" : "; ") + one.message;
    if (!one.hint.empty()) text += " (" + one.hint + ")";
  }
  return text;
}

}  // namespace armature::base
