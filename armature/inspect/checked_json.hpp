// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::inspect {

/// A deployment that was checked, as far as it could be read and built.
struct Checked {
  const std::string& file;
  const base::Diagnostics& diagnostics;
  const exec::Blueprint& blueprint;
  const exec::Plan& plan;  ///< counts if there is no error
};

/// How `checked_as_json` writes.
struct CheckedForm {
  /// Reads a file in which something was found.
  std::function<base::Result<std::string>(const std::string& file)> read;
  bool members = true;  ///< of each component its ports, properties, ... with their values
  int indent = 2;       ///< -1: all on one line
};

/// For editors: what was found, with places and changes that mend it; the components as they were
/// built, with the sizes and units that their properties give their ports; connections; threads in
/// the order of execution (docs/check_json.md).
std::string checked_as_json(const Checked& checked, const CheckedForm& form);

/// What was found alone, a list as in there.
/// @param read  as in CheckedForm
std::string diagnostics_as_json(
    const base::Diagnostics& diagnostics,
    const std::function<base::Result<std::string>(const std::string& file)>& read);

}  // namespace armature::inspect
