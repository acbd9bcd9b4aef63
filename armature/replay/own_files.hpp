// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/replay/experiment.hpp"

namespace armature::replay {

// Files that components change while they run, such as the poses and motions that a Teacher is
// taught. A run keeps what was in them at its start; a replay works on a copy of that.

/// Whether a property of that name leads to files that its component changes.
bool names_own_files(std::string_view property);

/// Adds to `to.own` what is in the files of components now.
void keep_own_files(const exec::Blueprint& blueprint, Experiment& to);

/// Lets components change copies in `folder`, which have what was there when the recorded run
/// began; of a component that this run had not, what is there now.
/// @thread before the application is made
void work_on_copies(exec::Blueprint& blueprint, const Experiment& experiment,
                    const std::string& folder, base::Diagnostics& diagnostics);

}  // namespace armature::replay
