// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace armature::foxglove::internal {
namespace {

/// Where a number will be; names of fields have no such character.
constexpr std::string_view kMark = "\"\\u0001\"";
const std::string kPlace = "\x01";

/// A step of a path, and what is behind it.
struct Step {
  std::string name;       ///< of a field; empty: an element
  std::size_t index = 0;  ///< from 0
};

std::vector<Step> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    const char kind = path.front();
    path.remove_prefix(1);
    if (kind == '[') {
      std::size_t number = 1;
      std::from_chars(path.data(), path.data() + path.size(), number);
      steps.push_back({"", number - 1});
      path.remove_prefix(std::min(path.find(']') + 1, path.size()));
    } else {
      const std::size_t end = std::min(path.find_first_of(".["), path.size());
      steps.push_back({std::string(path.substr(0, end)), 0});
      path.remove_prefix(end);
    }
  }
  return steps;
}

const Shape* member_of(const Shape* shape, const Step& step) {
  if (shape == nullptr) return nullptr;
  if (step.name.empty()) return shape->members.empty() ? nullptr : &shape->members[0];
  const auto found = std::ranges::find(shape->members, step.name, &Shape::name);
  return found == shape->members.end() ? nullptr : &*found;
}

void append_number(double number, bool is_bool, std::string& to) {
  if (std::isnan(number)) {
    to += "null";
  } else if (std::isinf(number)) {
    to += number < 0.0 ? "-1e999" : "1e999";  // as in recordings
  } else if (is_bool) {
    to += number != 0.0 ? "true" : "false";
  } else {
    std::array<char, 32> digits{};
    to.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  }
}

}  // namespace

NumberText::NumberText(const Shape& shape, const std::vector<std::string>& paths) {
  Json whole = Json::object();
  for (const std::string& path : paths) {
    const Shape* at = &shape;
    Json* place = shape.kind == Shape::Kind::kStruct ? &whole : &whole["value"];
    for (const Step& step : steps_of(path)) {
      at = member_of(at, step);
      place = step.name.empty() ? &(*place)[step.index] : &(*place)[step.name];
    }
    *place = kPlace;
    is_bool_.push_back(at != nullptr && at->kind == Shape::Kind::kBool);
  }
  const std::string text = text_of(whole);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(kMark, begin), text.size());
    pieces_.push_back(text.substr(begin, end - begin));
    begin = end == text.size() ? end + 1 : end + kMark.size();
  }
}

std::string NumberText::filled(std::span<const double> numbers) const {
  std::string text = pieces_.front();
  for (std::size_t i = 0; i + 1 < pieces_.size() && i < numbers.size(); ++i) {
    append_number(numbers[i], is_bool_[i], text);
    text += pieces_[i + 1];
  }
  return text;
}

}  // namespace armature::foxglove::internal
