// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/bundle/bundle.hpp"
#include "armature/bundle/internal/architecture.hpp"
#include "armature/bundle/internal/texts.hpp"
#include "armature/document/document.hpp"

namespace armature::bundle::internal {

/// A file as it comes into a bundle.
struct Copy {
  std::string file;
  base::Location where;  ///< at which the deployment names it; of programs nowhere
};

/// What a bundle has, and where it is made.
struct Plan {
  Facts facts;
  const Architecture* architecture = nullptr;
  bool foreign = false;                     ///< for another machine than this one
  std::string system;                       ///< if it is, the root of a system for it
  std::map<std::string, Copy> copies;       ///< by their places in the bundle
  std::map<std::string, std::string> keys;  ///< place -> private key, which is not copied
  std::vector<std::string> check_options;   ///< of `armature check`, as the run has them
  std::string target;
};

/// Finds all that the bundle needs; nothing after an error.
std::optional<Plan> plan_bundle(const BundleRequest& request, const document::Document& document,
                                base::Diagnostics& diagnostics);

}  // namespace armature::bundle::internal
