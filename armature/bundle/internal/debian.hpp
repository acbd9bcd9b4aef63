// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::bundle::internal {

/// Which Debian packages libraries are of.
struct Packages {
  std::set<std::string> names;         ///< without architecture
  std::vector<std::string> strangers;  ///< libraries that no package of this machine has
};

/// @param libraries  name -> file, empty if it was not found
Packages packages_of(const std::map<std::string, std::string>& libraries);

/// The package that an archive has; empty if it is none.
std::string package_in(const std::string& archive);

/// Makes the archive `file` of what lies in `folder`, equal to the byte each time.
base::Result<void> build_package(const std::string& folder, const std::string& file);

/// Of all files that are made, in seconds since 1970: what SOURCE_DATE_EPOCH says, else a constant.
std::int64_t time_of_files();

}  // namespace armature::bundle::internal
