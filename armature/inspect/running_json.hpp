// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/inspect/view.hpp"

namespace armature::inspect {

/// An application that runs, in the form of `checked_as_json`: its components with what their
/// properties are now, its connections, its threads with their components in the order of the
/// deployment. Nothing has a place in a file; an activity's `kind` is all that is said of it
/// (`every 10 ms`); modes are not told.
/// @param where  stands as `file`: its address
/// @throws NoAnswer
std::string running_as_json(View& view, const std::string& where);

}  // namespace armature::inspect
