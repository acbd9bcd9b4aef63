// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/exec/application.hpp"
#include "armature/runner/console.hpp"

namespace armature::runner {

// What is said of a run.

/// Which real-time properties were asked for and granted.
void tell_verdict(const exec::Application& application, const Console& console);
/// What the operator need not do here.
void tell_grants(const std::vector<exec::Grant>& grants, const Console& console);
/// @param all  also of threads that lost nothing
void tell_statistics(const exec::Application& application, bool all, const Console& console);
void tell_lost_lines(const Console& console);
/// Names every component that did not get to the end in good order.
void tell_casualties(const exec::Application& application, const Console& console);

}  // namespace armature::runner
