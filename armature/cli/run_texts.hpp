// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/cli/console.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/application.hpp"

namespace armature::cli {

// What `armature run` says of a run.

/// Which real-time properties were asked for and granted.
void tell_verdict(const exec::Application& application, const Console& console);
/// What the operator need not do here.
void tell_grants(const document::Document& document, const Console& console);
/// @param all  also of threads that lost nothing
void tell_statistics(const exec::Application& application, bool all, const Console& console);
void tell_lost_lines(const Console& console);
/// Names every component that did not get to the end in good order.
void tell_casualties(const exec::Application& application, const Console& console);

}  // namespace armature::cli
