// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/cli/arguments.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/inspect/fitting.hpp"

namespace armature::cli {

/// Answers an editor that checks a deployment again and again: a request and its answer are a line
/// of JSON each (docs/check_json.md). Component libraries stay loaded in between; one that crashes
/// takes the process with it, and whoever started it starts another.
class CheckService {
 public:
  /// Loads and checks a deployment, whose files are read by `read`.
  using Load = std::function<deploy::Deployment(const LoadArguments&, deploy::FileReader read)>;

  CheckService(std::vector<std::string> library_folders, Load load);
  ~CheckService();

  /// The answer to a request, one line; what is wrong with the request is its `error`.
  std::string answer(std::string_view request);

 private:
  struct Request;

  base::Result<std::string> result_of(const Request& request);
  std::string check(const Request& request);
  base::Result<std::string> fitting(const Request& request);
  base::Result<std::string> models(const Request& request) const;

  const std::vector<std::string> library_folders_;
  const Load load_;
  std::unique_ptr<deploy::Deployment> last_;
  std::unique_ptr<inspect::ModelPorts> model_ports_;  ///< of `last_`'s libraries
  std::vector<std::string> model_names_;              ///< for which `model_ports_` was made
};

}  // namespace armature::cli
