// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/places.hpp"

#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace armature::studio::internal {

using Json = nlohmann::json;

namespace {

std::int32_t on_grid(double pixels) {
  constexpr double kFarthest = 1e6;
  const double steps = std::round(pixels / Places::kGrid);
  return std::isfinite(steps) && std::abs(steps) < kFarthest ? static_cast<std::int32_t>(steps) : 0;
}

bool is_pair_of_numbers(const Json& json) {
  return json.is_array() && json.size() == 2 && json[0].is_number() && json[1].is_number();
}

std::string as_json(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The component of `Sensor.Positions`.
std::string_view owner_of(std::string_view port) { return port.substr(0, port.rfind('.')); }

/// What has a name inside of a composite gets the name without it.
template <typename Value>
void bring_out(std::map<std::string, Value>& named, const std::string& inside) {
  for (auto at = named.lower_bound(inside); at != named.end() && at->first.starts_with(inside);) {
    auto part = named.extract(at++);
    part.key().erase(0, inside.size());
    named.insert(std::move(part));
  }
}

}  // namespace

base::Result<Places> Places::parse(const std::string& text) {
  Places places;
  if (text.empty()) return places;
  const Json json = Json::parse(text, nullptr, false);
  const auto boxes = json.is_object() ? json.find("boxes") : json.end();
  if (!json.is_object() || boxes == json.end() || !boxes->is_object()) {
    return base::Error{R"(expected {"boxes": {"NAME": [x, y], ...}})"};
  }
  for (const auto& [box, place] : boxes->items()) {
    if (!is_pair_of_numbers(place))
      return base::Error{"the place of '" + box + "' must be [x, y], in pixels"};
    places.set(box, place[0].get<double>(), place[1].get<double>());
  }
  const auto robots = json.find("robots");
  if (robots == json.end()) return places;
  if (!robots->is_object()) return base::Error{R"(expected "robots": {"NAME": "PORT", ...})"};
  for (const auto& [component, port] : robots->items()) {
    if (!port.is_string())
      return base::Error{"the port of the robot '" + component + "' must be a text"};
    places.move_by(component, port.get<std::string>());
  }
  return places;
}

void Places::set(const std::string& box, double x, double y) {
  boxes_[box] = {on_grid(x), on_grid(y)};
}

void Places::move_by(const std::string& component, const std::string& port) {
  if (port.empty()) {
    robots_.erase(component);
  } else {
    robots_[component] = port;
  }
}

void Places::rename(const std::string& from, const std::string& to) {
  if (auto box = boxes_.extract(from)) {
    box.key() = to;
    boxes_.insert(std::move(box));
  }
  if (auto robot = robots_.extract(from)) {
    robot.key() = to;
    robots_.insert(std::move(robot));
  }
  for (auto& [component, port] : robots_) {
    if (owner_of(port) == from) port.replace(0, from.size(), to);
  }
}

void Places::remove(const std::string& component) {
  boxes_.erase(component);
  robots_.erase(component);
  std::erase_if(robots_, [&](const auto& robot) { return owner_of(robot.second) == component; });
}

void Places::dissolve(const std::string& box) {
  boxes_.erase(box);
  const std::string inside = box + ".";
  bring_out(boxes_, inside);
  bring_out(robots_, inside);
  for (auto& [component, port] : robots_) {
    if (port.starts_with(inside)) port.erase(0, inside.size());
  }
}

std::string Places::to_text() const {
  std::string text = "{\"boxes\": {";
  const char* separator = "\n  ";
  for (const auto& [box, place] : boxes_) {
    text += separator + as_json(box) + ": [" + std::to_string(place.x * kGrid) + ", " +
            std::to_string(place.y * kGrid) + "]";
    separator = ",\n  ";
  }
  if (robots_.empty()) return text + "\n}}\n";
  text += "\n},\n\"robots\": {";
  separator = "\n  ";
  for (const auto& [component, port] : robots_) {
    text += separator + as_json(component) + ": " + as_json(port);
    separator = ",\n  ";
  }
  return text + "\n}}\n";
}

}  // namespace armature::studio::internal
