// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/exec/application.hpp"

namespace armature::benchmarks {

/// For an application whose threads take turns in the calling one.
inline exec::ApplicationOptions simulated() {
  exec::ApplicationOptions options;
  options.simulated = true;
  return options;
}

}  // namespace armature::benchmarks
