// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/plan.hpp"

namespace armature::analysis {

/// How much of a wiring a picture shows.
struct GraphOptions {
  bool each_line = false;         ///< every component and connection by itself, nothing bundled
  std::vector<std::string> only;  ///< these components and their neighbours; empty: all
};

/// The components that `text` names: `Source`, or `Joint{1..7}` for seven of them.
/// @return an error for an impossible range, or for a name that no component has, with a near one
base::Result<std::vector<std::string>> components_named(const std::string& text,
                                                        const exec::Blueprint& blueprint);

/// The wiring of a checked application: a box for each thread with its components and their models,
/// an arrow from writer to reader for each connection with its ports (bold if it triggers), a
/// dashed one from a component to each of its peers. Components that differ by the number at the
/// end of their names share a box, and connections of one kind between two boxes an arrow that says
/// how many they are and lists them.
std::string graph_as_svg(const exec::Blueprint& blueprint, const exec::Plan& plan,
                         const GraphOptions& options = {});
std::string graph_as_dot(const exec::Blueprint& blueprint, const exec::Plan& plan,
                         const GraphOptions& options = {});
std::string graph_as_mermaid(const exec::Blueprint& blueprint, const exec::Plan& plan,
                             const GraphOptions& options = {});

}  // namespace armature::analysis
