// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/browser/browser.hpp"
#include "armature/cli/commands.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/script.hpp"
#include "armature/record/timeline_writer.hpp"

namespace armature::cli {

/// What accompanies the runs that want it.
struct Companions {
  std::unique_ptr<lua::Script> script;               ///< `--script`
  std::unique_ptr<browser::Browser> browser;         ///< `--browse`
  std::unique_ptr<record::TimelineWriter> timeline;  ///< `--trace`
};

/// Those that `arguments` ask for; what is wrong is added to `diagnostics`.
Companions make_companions(const RunArguments& arguments, base::Diagnostics& diagnostics);

}  // namespace armature::cli
