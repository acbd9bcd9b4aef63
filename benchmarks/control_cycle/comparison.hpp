// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/exec/application.hpp"
#include "benchmarks/control_cycle/monolithic.hpp"

namespace armature::benchmarks {

/// Says which motor of the application's cycle is not, to the last bit, in the state of the loop's,
/// which does the cycles first that it is behind; empty if all are. To be asked between two cycles.
std::string difference_of(const exec::Application& application, MonolithicController& loop,
                          int joints);

}  // namespace armature::benchmarks
