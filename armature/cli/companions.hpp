// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/browser/browser.hpp"
#include "armature/cli/arguments.hpp"
#include "armature/cli/commands.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/script.hpp"
#include "armature/record/timeline_writer.hpp"

namespace armature::cli {

/// What accompanies the runs that want it.
struct Companions {
  std::unique_ptr<lua::Script> script;               ///< `--script`
  std::unique_ptr<browser::Browser> browser;         ///< `--browse`, TaskBrowser
  std::unique_ptr<record::TimelineWriter> timeline;  ///< `--trace`
};

/// Those that `arguments` ask for; what is wrong is added to `diagnostics`.
/// @param prompted  the deployment has a TaskBrowser: somebody at a terminal, who gave neither a
///                  script nor `--for`, gets the prompt
Companions make_companions(const RunArguments& arguments, bool prompted,
                           base::Diagnostics& diagnostics);

}  // namespace armature::cli
