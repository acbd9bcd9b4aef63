// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/bundle/internal/architecture.hpp"
#include "armature/document/document.hpp"

namespace armature::bundle::internal {

/// The programs and libraries that run a deployment.
struct ProgramFiles {
  std::map<std::string, std::string> own;     ///< place in the bundle -> file
  std::map<std::string, std::string> system;  ///< library -> file, empty if it was not found
};

/// Where the system's loader finds a library without being told; empty if it does not.
/// @param root  of the system; empty: of this one
std::string system_file(const std::string& root, const std::string& library,
                        const Architecture& architecture);

/// An installed Armature: bin/armature, and beside that lib/ and lib/armature/.
class Installation {
 public:
  /// Its programs must be for `architecture`, and look for their libraries beside themselves.
  Installation(std::string folder, const Architecture& architecture)
      : folder_(std::move(folder)), architecture_(architecture) {}

  std::string component_folder() const { return folder_ + "/lib/armature"; }
  std::string licence() const { return folder_ + "/share/doc/armature/LICENSE"; }

  /// What is needed to run component libraries, by what their files say.
  /// @param components  found in `folders`; they come into lib/armature
  /// @param others      component libraries that stay in the deployment's folder, by path
  ProgramFiles files(const std::vector<document::Reference>& components,
                     const std::vector<std::string>& folders,
                     const std::vector<std::string>& others, base::Diagnostics& diagnostics) const;

 private:
  const std::string folder_;
  const Architecture& architecture_;
};

}  // namespace armature::bundle::internal
