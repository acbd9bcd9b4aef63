// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/watch.hpp"

#include <algorithm>
#include <cstdio>

#include "armature/base/seconds.hpp"
#include "armature/base/unit.hpp"

namespace armature::browser::internal {
namespace {

constexpr std::size_t kTimeColumns = 10;
constexpr std::size_t kLeastColumns = 10;
constexpr std::size_t kFewElements = 4;

std::string padded(const std::string& text, std::size_t columns) {
  const std::size_t has = columns_of(text);
  return has < columns ? std::string(columns - has, ' ') + text : text;
}

std::string time_text(double seconds) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

}  // namespace

std::optional<base::Duration> seconds_in(std::string_view text) {
  constexpr double kLongestSeconds = 1e9;
  const auto quantity = base::parse_quantity(text);
  if (!quantity) return std::nullopt;
  const std::string unit = quantity.value().unit.empty() ? "s" : quantity.value().unit;
  const auto seconds = base::convert(quantity.value().value, unit, "s");
  if (!seconds || !(seconds.value() > 1e-9 && seconds.value() <= kLongestSeconds)) {
    return std::nullopt;
  }
  return base::from_seconds(seconds.value());
}

base::Result<Watch> Watch::parse(Robot& robot, const std::vector<std::string>& words) {
  Watch watch;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "every" && words[i] != "for") {
      watch.items_.push_back({words[i], {}});
      continue;
    }
    const std::string found = i + 1 < words.size() ? words[i + 1] : "nothing";
    const auto time = seconds_in(found);
    if (!time)
      return base::Error{words[i] + " takes seconds above 0, for example 0.2, found " + found};
    (words[i] == "every" ? watch.every_ : watch.limit_.emplace()) = *time;
    ++i;
  }
  if (watch.items_.empty()) {
    return base::Error{"watch takes the items to show: watch Joint1.Position every 0.2"};
  }
  const std::vector<remote::ItemValue> values = watch.read(robot);
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Without a type it is nothing that could ever be looked at.
    if (values[i].type.empty()) return base::Error{values[i].error};
    watch.items_[i] = {values[i].item, values[i].unit};
  }
  return watch;
}

std::vector<remote::ItemValue> Watch::read(Robot& robot) const {
  std::vector<std::string> items;
  for (const Item& item : items_) items.push_back(item.text);
  return robot.read(items, kFewElements);
}

std::vector<std::string> Watch::values(Robot& robot) const {
  std::vector<std::string> texts;
  for (const remote::ItemValue& value : read(robot)) {
    const bool answered = value.written || value.error.empty();
    texts.push_back(!answered              ? "no answer"
                    : !value.written       ? "not yet"
                    : !value.error.empty() ? "none"
                                           : value.value);
  }
  return texts;
}

std::string Watch::name_of(const Item& item) {
  return item.unit.empty() ? item.text : item.text + " [" + item.unit + "]";
}

std::string Watch::picture(const Paper& paper, Robot& robot) const {
  const std::vector<std::string> texts = values(robot);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const std::string& unit = items_[i].unit;
    rows.push_back({inked(paper, Ink::kName, items_[i].text),
                    unit.empty() ? texts[i] : texts[i] + " " + unit});
  }
  return table(paper, rows);
}

bool Watch::fits(const Paper& paper) const {
  std::size_t columns = kTimeColumns;
  for (const Item& item : items_) columns += 2 + std::max(kLeastColumns, columns_of(name_of(item)));
  return columns <= paper.width;
}

std::string Watch::heading(const Paper& paper) const {
  if (!fits(paper)) return {};
  std::string text = padded("time", kTimeColumns);
  for (const Item& item : items_) {
    text += "  " + padded(name_of(item), kLeastColumns);
  }
  return inked(paper, Ink::kHeading, text);
}

std::string Watch::line(const Paper& paper, Robot& robot, double seconds) const {
  const std::vector<std::string> texts = values(robot);
  std::string text = padded(time_text(seconds), kTimeColumns);
  const bool columns = fits(paper);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const Item& item = items_[i];
    if (columns) {
      text += "  " + padded(texts[i], std::max(kLeastColumns, columns_of(name_of(item))));
    } else {
      text += (i == 0 ? "" : "\n" + std::string(kTimeColumns, ' ')) + "  " + item.text + " " +
              texts[i] + (item.unit.empty() ? "" : " " + item.unit);
    }
  }
  return text;
}

void watch_in_place(const Watch& watch, Robot& robot, Session& session, Surface& surface) {
  const base::Duration limit = watch.limit().value_or(base::Duration::max());
  bool key = false;
  const auto key_came = [&] { return key = key || surface.take_key(); };
  std::string picture;
  base::Duration passed{};
  base::Duration step{};
  do {
    passed += step;
    step = std::min(watch.every(), limit - passed);
    const Paper paper = surface.paper();
    picture = watch.picture(paper, robot);
    surface.show(picture + "\n" + inked(paper, Ink::kFaint, "any key ends it"));
  } while (session.let_pass(step, key_came) && passed + step < limit);
  surface.show("");
  surface.say(picture);
}

void watch_by_lines(const Watch& watch, Robot& robot, Session& session, Surface& surface) {
  constexpr int kUsualLines = 10;
  const base::Duration limit = watch.limit().value_or(kUsualLines * watch.every());
  bool key = false;
  const auto key_came = [&] { return key = key || surface.take_key(); };
  const std::string heading = watch.heading(surface.paper());
  if (!heading.empty()) surface.say(heading);
  for (base::Duration passed{}; passed < limit;) {
    const base::Duration step = std::min(watch.every(), limit - passed);
    if (!session.let_pass(step, key_came)) return;
    passed += step;
    surface.say(watch.line(surface.paper(), robot, session.stamp(passed)));
  }
}

}  // namespace armature::browser::internal
