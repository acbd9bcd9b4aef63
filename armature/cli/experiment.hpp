// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "armature/cli/arguments.hpp"
#include "armature/cli/console.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/replay/acts.hpp"

namespace armature::cli {

/// What a run leaves in its folder so that it can be done again (docs/replay.md). A run without a
/// folder leaves nothing.
class ExperimentRecord {
 public:
  /// For `load`: keeps what is read.
  deploy::FileSeen seen();

  /// What runs, and room for what will be done to it; before the start.
  /// @return false after an error, which was shown
  bool begin(const deploy::Deployment& deployment, const RunArguments& arguments,
             const Console& console);
  bool keeps_acts() const { return acts_ != nullptr; }
  void add(const exec::Act& act) { acts_->add(act); }
  /// @return false after an error, which was shown
  bool end(const Console& console);

 private:
  std::map<std::string, std::string> texts_;
  std::unique_ptr<replay::ActsWriter> acts_;
  bool simulated_ = false;  ///< else it is a pity, but no failure, if it cannot be replayed
};

}  // namespace armature::cli
