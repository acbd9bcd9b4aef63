// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/places.hpp"

#include <cmath>

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
  return places;
}

void Places::set(const std::string& box, double x, double y) {
  boxes_[box] = {on_grid(x), on_grid(y)};
}

void Places::rename(const std::string& from, const std::string& to) {
  auto box = boxes_.extract(from);
  if (box.empty()) return;
  box.key() = to;
  boxes_.insert(std::move(box));
}

void Places::dissolve(const std::string& box) {
  const std::string inside = box + ".";
  remove(box);
  for (auto at = boxes_.lower_bound(inside); at != boxes_.end() && at->first.starts_with(inside);) {
    auto part = boxes_.extract(at++);
    part.key().erase(0, inside.size());
    boxes_.insert(std::move(part));
  }
}

std::string Places::to_text() const {
  std::string text = "{\"boxes\": {";
  const char* separator = "\n  ";
  for (const auto& [box, place] : boxes_) {
    text += separator + Json(box).dump(-1, ' ', false, Json::error_handler_t::replace) + ": [" +
            std::to_string(place.x * kGrid) + ", " + std::to_string(place.y * kGrid) + "]";
    separator = ",\n  ";
  }
  return text + "\n}}\n";
}

}  // namespace armature::studio::internal
