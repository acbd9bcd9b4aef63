// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/plan.hpp"

namespace armature::deploy::internal {

/// Refuses inputs of the operator from which anything leads to what moves, by data, calls or
/// events: a value typed at the prompt passes no generator and no arming. Refused, too, are inputs
/// that have a writer.
void check_operator_inputs(const document::Document& document, const exec::Blueprint& blueprint,
                           const exec::Plan& plan, base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
