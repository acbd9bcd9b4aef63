// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::generate::internal {

/// A component library that a program is linked with.
struct UsedLibrary {
  std::string name;   ///< `motion`, of libmotion.so
  std::string entry;  ///< its function for programs that are linked with several libraries
};

/// Those of the deployment's libraries that its components are from, in its order. An error names a
/// library that cannot be linked.
/// @param folders  where libraries are looked for
std::vector<UsedLibrary> used_libraries(const deploy::Deployment& deployment,
                                        const std::vector<std::string>& folders,
                                        base::Diagnostics& diagnostics);

}  // namespace armature::generate::internal
