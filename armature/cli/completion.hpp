// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace armature::cli {

/// What a deployment has that options name.
struct DeploymentNames {
  std::vector<std::string> parameters;
  std::vector<std::string> components;
  std::vector<std::string> properties;  ///< `Component.property`
  std::vector<std::string> modes;
};

/// Reads those of a file; empty lists if it cannot be read.
using ReadNames = std::function<DeploymentNames(const std::string& file)>;

/// What the last of `words` may become, for a shell: commands, options, and what the deployment
/// among the words has. None means that a file is wanted, or something that nobody can know. A
/// candidate that ends with `.` or `=` goes on.
/// @param words  as typed, after the program's name; the last one may be empty
std::vector<std::string> completions(const CLI::App& program, const std::vector<std::string>& words,
                                     const ReadNames& read);

}  // namespace armature::cli
