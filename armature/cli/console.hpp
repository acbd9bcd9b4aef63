// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/runner/console.hpp"

namespace armature::cli {

using runner::Console;

}  // namespace armature::cli
