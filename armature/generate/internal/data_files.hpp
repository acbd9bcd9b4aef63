// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::generate::internal {

/// Files that properties name by an absolute path, such as the description of a robot that a
/// deployment names by `${here}/...`: a program has copies of them.
struct DataFiles {
  std::map<std::string, std::string> names;  ///< by path: what the copy is called

  /// The copy's name; nullptr if the property names no such file.
  const std::string* name_of(const component::PropertyBase& property) const;
};

/// Which properties are files is known to their components alone: a text that names one is it. The
/// error: a path that follows from the deployment's folder and leads to no file, which the program
/// would look for on this machine.
DataFiles find_data_files(const deploy::Deployment& deployment, base::Diagnostics& diagnostics);

}  // namespace armature::generate::internal
