// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::generate {

/// What a program is generated of, and where.
struct GenerateRequest {
  std::string file;                          ///< the deployment, absolute
  std::vector<std::string> library_folders;  ///< for component libraries, before all others
  std::string out;  ///< folder of its sources; empty: NAME-program in the working directory
};

/// Writes a deployment as a program in C++ that has no files to read but those of its data
/// (docs/generate.md). The same deployment gives the same bytes. A folder that was generated before
/// is written anew, and what else is in it stays; any other folder with something in it is refused.
/// Errors: the deployment has what such a program cannot do; a file cannot be written.
/// @param deployment  which has passed the check
/// @return the folder; empty after an error
std::string generate(const GenerateRequest& request, const deploy::Deployment& deployment,
                     base::Diagnostics& diagnostics);

/// `generate` as who loads this library when it is asked for has it.
using Generate = std::string(const GenerateRequest&, const deploy::Deployment&, base::Diagnostics&);
inline constexpr const char* kGenerateSymbol = "armature_generate_program";

}  // namespace armature::generate
