// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::exec {

/// Why an output cannot be connected to an input, and what to do about it.
struct Mismatch {
  std::string message;
  std::string hint;
};

// Called by any thread while the components do not run; allocate.

/// How the type, the unit or the declared size of two ports differ; empty if they fit.
std::optional<Mismatch> mismatch(const component::OutputPortBase& output,
                                 const component::InputPortBase& input);

/// Likewise, but of the size, which properties of the components may change yet.
std::optional<Mismatch> mismatch_but_size(const component::OutputPortBase& output,
                                          const component::InputPortBase& input);

}  // namespace armature::exec
