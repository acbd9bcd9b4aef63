// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>

#include "armature/document/document.hpp"

namespace armature::configurations {

using Random = std::mt19937;

/// One change of a deployment.
struct Mutation {
  std::string kind;  ///< `gain`, `wire`, ...: the row of the table
  std::string what;  ///< `WAM.Kp: [900, ...] -> [9000, ...]`
};

/// Changes one thing of a deployment as somebody might who is in a hurry: a number by powers of
/// ten, a sign, a unit, a period, a gain, a limit, the size of a list, a switch, an activity, a
/// grant, a wire, a peer, a component, a mode, what is done at a stop, who may come in, a bus. What
/// a real robot would not have in its file is left alone: properties of the simulated plant.
Mutation mutate(document::Document& document, Random& random);

}  // namespace armature::configurations
