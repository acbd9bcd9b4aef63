// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/deployment_in.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

bool is_deployment(const std::filesystem::path& path) {
  if (path.extension() != ".yaml" && path.extension() != ".yml") return false;
  const auto text = platform::read_file(path.string());
  return text && ('\n' + text.value()).find("\napplication:") != std::string::npos;
}

void collect(const std::filesystem::path& folder, std::vector<std::string>& found) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (is_deployment(entry.path())) found.push_back(entry.path().string());
  }
}

}  // namespace

base::Result<std::string> deployment_in(const std::string& folder) {
  std::vector<std::string> found;
  collect(folder, found);
  collect(std::filesystem::path(folder) / "deployments", found);
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    const std::string begin = (std::filesystem::path(folder) / "robot.yaml").string();
    return base::Error{"'" + folder +
                       "' has no deployment, a file with `application: NAME`: begin " +
                       "one by its name, as in `armature studio " + begin + "`"};
  }
  std::ranges::sort(found);
  std::string names;
  for (const std::string& one : found) names += "\n  " + one;
  return base::Error{"'" + folder + "' has several deployments: name one of them" + names};
}

}  // namespace armature::cli
