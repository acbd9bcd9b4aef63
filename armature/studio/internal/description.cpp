// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/description.hpp"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "armature/base/quoted.hpp"
#include "armature/platform/file.hpp"

namespace armature::studio::internal {

using Json = nlohmann::json;

namespace {

/// As controllers::RobotDescription calls it.
constexpr const char* kProperty = "robot_description";
constexpr std::size_t kMostBytes = 4u << 20;

bool names(const Json& property, const std::string& path) {
  return property.value("name", "") == kProperty && property.value("value", "") == path;
}

/// Whether a component of the deployment has this description.
bool is_named(const std::string& path, const std::string& findings) {
  const Json found = Json::parse(findings, nullptr, false);
  if (path.empty() || !found.is_object()) return false;
  return std::ranges::any_of(found.value("components", Json::array()), [&](const Json& component) {
    return std::ranges::any_of(component.value("properties", Json::array()),
                               [&](const Json& property) { return names(property, path); });
  });
}

/// Without what may stand before the first element: declarations and comments.
std::string_view first_element(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find('<'), text.size()));
    const bool comment = text.starts_with("<!--");
    if (!comment && !text.starts_with("<?")) return text;
    const std::string_view end = comment ? "-->" : "?>";
    const std::size_t at = text.find(end);
    if (at == std::string_view::npos) return {};
    text.remove_prefix(at + end.size());
  }
}

}  // namespace

base::Result<std::string> read_description(const std::string& path, const std::string& findings) {
  if (!is_named(path, findings)) {
    return base::Error{base::quoted(path) + " is no robot's description of this deployment"};
  }
  auto text = platform::read_file(path, kMostBytes);
  if (!text) return base::Error{text.error()};
  if (!first_element(text.value()).starts_with("<robot")) {
    return base::Error{base::quoted(path) + " is no robot's description: expected <robot>"};
  }
  return text;
}

}  // namespace armature::studio::internal
