// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::generate::internal {

/// Tells what the deployment has that a generated program cannot do: each is an error at its place.
/// What is for tools alone, such as grants and acts of the operator, is a note.
void refuse_what_needs_tools(const deploy::Deployment& deployment, base::Diagnostics& diagnostics);

}  // namespace armature::generate::internal
