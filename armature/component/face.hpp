// SPDX-License-Identifier: Apache-2.0
#pragma once

// The way from what an author declares to what the runtime does with it. An author's
// `OutputPort<double>` writes; its runtime's side, an `OutputPortBase`, is connected, tapped,
// shown.

#include "armature/component/internal/inside.hpp"

namespace armature::component {

/// The runtime's side of a port, operation, command, event, or of the use of one:
/// `face(writer.out).connect(face(reader.in), {})`.
template <typename Declared>
auto& face(Declared& declared) {
  return internal::Inside::face(declared);
}

}  // namespace armature::component
