// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/experiment.hpp"

#include <filesystem>
#include <system_error>
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
  // In real time they would not come again at the same cycles: nothing is added to such a run.
  std::error_code ignored;
  std::filesystem::remove(arguments.output_folder + '/' + replay::kActsFile, ignored);
  if (!arguments.simulated) return written.ok();
  auto acts = replay::ActsWriter::create(arguments.output_folder);
  if (!acts) console.say(rt::LogLevel::kError, acts.error());
  if (!written || !acts) return false;
  acts_ = std::move(acts).value();
  return true;
}

bool ExperimentRecord::end(const Console& console) {
  if (acts_ == nullptr) return true;
  const auto closed = acts_->close();
  if (!closed) console.say(rt::LogLevel::kError, closed.error());
  return closed.ok();
}

}  // namespace armature::cli
