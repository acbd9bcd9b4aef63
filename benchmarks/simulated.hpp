// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/exec/application.hpp"

namespace armature::benchmarks {

/// For an application whose threads take turns in the calling one, with all that it has by default
/// when `armature run` runs it.
inline exec::ApplicationOptions simulated() {
  exec::ApplicationOptions options;
  options.simulated = true;
  options.black_box.write = [](const exec::BlackBoxReport&) { return std::string(); };
  return options;
}

}  // namespace armature::benchmarks
