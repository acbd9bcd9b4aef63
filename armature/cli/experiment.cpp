// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/experiment.hpp"

#include <utility>

#include "armature/replay/experiment.hpp"
#include "armature/replay/recorded_deployment.hpp"

namespace armature::cli {

deploy::FileSeen ExperimentRecord::seen() {
  return [this](const std::string& path, const std::string& text) { texts_[path] = text; };
}

bool ExperimentRecord::begin(const deploy::Deployment& deployment, const RunArguments& arguments,
                             const Console& console) {
  if (arguments.output_folder.empty()) return true;
  const replay::Ran how{.version = ARMATURE_VERSION,
                        .simulated = arguments.simulated,
                        .overrides = arguments.load.overrides,
                        .mode = arguments.load.mode,
                        .library_folders = arguments.load.library_folders};
  const auto written = replay::write_experiment(
      arguments.output_folder, replay::experiment_of(deployment, std::move(texts_), how));
  if (!written) console.say(rt::LogLevel::kError, written.error());
  simulated_ = arguments.simulated;
  auto acts = replay::ActsWriter::create(
      arguments.output_folder, simulated_ ? replay::ActsWait::kForTheFile : replay::ActsWait::kNot);
  if (!acts) console.say(rt::LogLevel::kError, acts.error());
  if (!written || !acts) return false;
  acts_ = std::move(acts).value();
  return true;
}

bool ExperimentRecord::end(const Console& console) {
  if (acts_ == nullptr) return true;
  const auto closed = acts_->close();
  if (closed) return true;
  console.say(simulated_ ? rt::LogLevel::kError : rt::LogLevel::kWarning, closed.error());
  return !simulated_;
}

}  // namespace armature::cli
