// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/deployment_root.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "armature/document/value_tree.hpp"

namespace armature::bundle::internal {
namespace {

using document::path_in_quotes;

constexpr std::array<std::string_view, 11> kOfTheSystem = {"/bin/",  "/boot/",  "/dev/",  "/etc/",
                                                           "/lib/",  "/lib64/", "/proc/", "/run/",
                                                           "/sbin/", "/sys/",   "/usr/"};

bool is_of_the_system(std::string_view path) {
  return std::ranges::any_of(kOfTheSystem,
                             [path](std::string_view folder) { return path.starts_with(folder); });
}

/// Where both have parted, with a slash at its end, as `folder` has one.
std::string common(const std::string& folder, const std::string& path) {
  const std::string same(folder.begin(), std::ranges::mismatch(folder, path).in1);
  return same.substr(0, same.rfind('/') + 1);
}

std::vector<std::string> all_paths(const DeploymentFiles& files) {
  std::vector<std::string> paths(files.keys.begin(), files.keys.end());
  paths.insert(paths.end(), files.saved.begin(), files.saved.end());
  for (const auto& [path, where] : files.files) paths.push_back(path);
  return paths;
}

}  // namespace

std::string deployment_root(const DeploymentFiles& files, base::Diagnostics& diagnostics) {
  const std::vector<std::string> paths = all_paths(files);
  if (paths.empty()) return {};
  std::string root = paths.front().substr(0, paths.front().rfind('/') + 1);
  for (const std::string& path : paths) {
    root = common(root, path);
    if (!is_of_the_system(path)) continue;
    const auto named = files.files.find(path);
    diagnostics.error(
        named == files.files.end() ? base::Location{} : named->second,
        path_in_quotes(path) + " belongs to the system, expected a file of the deployment",
        "copy it beside the deployment, and name the copy");
  }
  if (root == "/" && diagnostics.ok()) {
    const auto [least, most] = std::ranges::minmax_element(paths);
    diagnostics.error({},
                      path_in_quotes(*least) + " and " + path_in_quotes(*most) +
                          " have no folder in common, expected the files of a deployment in one "
                          "tree of folders",
                      "copy them into one");
  }
  return diagnostics.ok() ? root : std::string();
}

}  // namespace armature::bundle::internal
