// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/diagnostic.hpp"
#include "idl/model.hpp"
#include "idl/source.hpp"

namespace armature::idl {

/// What the text of one file says, without a look at its meaning: names may be unknown or used
/// twice. Goes on behind a mistake, so that all of them are found in one run. `docs/idl.md` has the
/// grammar.
Module parse(const Source& source, base::Diagnostics& diagnostics);

}  // namespace armature::idl
