// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/deploy/deployment.hpp"
#include "armature/generate/internal/data_files.hpp"
#include "armature/generate/internal/used_libraries.hpp"

namespace armature::generate::internal {

/// What the texts of a program tell.
struct Facts {
  std::string name;        ///< of the program, from the application's
  std::string deployment;  ///< `deployments/pid.yaml`: the file with its folder's name
  std::vector<UsedLibrary> libraries;
  DataFiles data;
};

/// main.cpp: what the deployment's blueprint has, in its order, as calls of `runner::Assembly`.
std::string main_text(const deploy::Deployment& deployment, const Facts& facts);

}  // namespace armature::generate::internal
