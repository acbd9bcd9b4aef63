// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::analysis {

/// The wiring of a checked application: a box for each thread with its components and their models,
/// an arrow from writer to reader for each connection with its ports (bold if it triggers), a
/// dashed one from a component to each of its peers.
std::string graph_as_svg(const exec::Blueprint& blueprint, const exec::Plan& plan);
std::string graph_as_dot(const exec::Blueprint& blueprint, const exec::Plan& plan);
std::string graph_as_mermaid(const exec::Blueprint& blueprint, const exec::Plan& plan);

}  // namespace armature::analysis
