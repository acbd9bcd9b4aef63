// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/teach/taught_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"

namespace armature::controllers {
namespace {

using base::Error;
using base::Result;
using control::TaughtSamples;

constexpr std::size_t kLongestName = 63;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// One that says something, without its comment.
struct Line {
  std::size_t number = 0;  ///< from 1
  std::string_view key;    ///< before the first colon
  std::string_view rest;   ///< behind it
  bool has_colon = false;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::size_t colon = line.find(':');
    const bool has_colon = colon != std::string_view::npos;
    lines.push_back({number, trimmed(line.substr(0, colon)),
                     has_colon ? trimmed(line.substr(colon + 1)) : std::string_view{}, has_colon});
  }
  return lines;
}

Error at_line(std::size_t number, const std::string& what) {
  return Error{"line " + std::to_string(number) + ": " + what};
}

std::optional<double> number_in(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

/// `[1, 2, 3]`, and what stands behind it.
struct Row {
  std::vector<double> numbers;
  std::string_view behind;
};

Result<Row> row_in(std::string_view text, std::size_t joints) {
  const std::size_t close = text.find(']');
  if (text.empty() || text.front() != '[' || close == std::string_view::npos) {
    return Error{"expected the positions of all joints, such as [0.1, -0.2], found " +
                 base::quoted(text)};
  }
  Row row{{}, trimmed(text.substr(close + 1))};
  std::string_view inside = trimmed(text.substr(1, close - 1));
  while (!inside.empty()) {
    const std::size_t comma = inside.find(',');
    const std::string_view one = trimmed(inside.substr(0, comma));
    const auto number = number_in(one);
    if (!number) return Error{"expected a finite number, found " + base::quoted(one)};
    row.numbers.push_back(*number);
    inside = comma == std::string_view::npos ? std::string_view{} : inside.substr(comma + 1);
  }
  if (row.numbers.size() != joints) {
    return Error{"has " + std::to_string(row.numbers.size()) + " positions, the robot has " +
                 std::to_string(joints) + " joints"};
  }
  return row;
}

/// As short as it is exact to a millionth.
std::string short_number(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", number);
  std::string shortest = text;
  shortest.erase(shortest.find_last_not_of('0') + 1);
  if (shortest.back() == '.') shortest.pop_back();
  return shortest == "-0" ? "0" : shortest;
}

template <typename Numbers>
std::string row_text(const Numbers& numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    if (text.size() > 1) text += ", ";
    text += short_number(number);
  }
  return text + "]";
}

/// What stands before the samples.
class Head {
 public:
  /// @return whether the line is one of it
  Result<bool> take(const Line& line) {
    if (line.key == "motion") return true;
    auto* const value = line.key == "joints" ? &joints : line.key == "samples" ? &samples : nullptr;
    if (value == nullptr) return false;
    const auto number = number_in(line.rest);
    if (!number || *number < 1.0 || *number > 1e7 || *number != std::floor(*number)) {
      return at_line(line.number, std::string(line.key) +
                                      " must be a whole number above 0, found " +
                                      base::quoted(line.rest));
    }
    *value = static_cast<std::size_t>(*number);
    return true;
  }
  std::size_t joints = 0;
  std::size_t samples = 0;
};

Result<void> take_sample(const Line& line, TaughtSamples& samples) {
  const auto time_s = number_in(line.key);
  if (!line.has_colon || !time_s) {
    return at_line(line.number, "expected a sample, such as 0.010: [0.1, -0.2], found " +
                                    base::quoted(line.key));
  }
  if (!samples.times_s.empty() && *time_s <= samples.times_s.back()) {
    return at_line(line.number, "the time " + std::string(line.key) +
                                    " s is not later than that of the sample before it");
  }
  auto row = row_in(line.rest, samples.axes);
  if (!row) return at_line(line.number, row.error());
  if (!row.value().behind.empty()) {
    return at_line(line.number, "expected nothing behind the positions, found " +
                                    base::quoted(row.value().behind));
  }
  samples.times_s.push_back(*time_s);
  samples.positions.insert(samples.positions.end(), row.value().numbers.begin(),
                           row.value().numbers.end());
  return {};
}

Result<std::pair<std::string, std::vector<double>>> pose_in(const Line& line, std::size_t joints) {
  if (!line.has_colon || !is_taught_name(line.key)) {
    return at_line(line.number,
                   "expected a pose, such as home: [0, 45] deg, found " + base::quoted(line.key));
  }
  auto row = row_in(line.rest, joints);
  if (!row) return at_line(line.number, "pose " + base::quoted(line.key) + ": " + row.error());
  const std::string unit(row.value().behind);
  const bool length = unit == "m" || unit == "mm";
  if (unit != "rad" && unit != "deg" && !length) {
    return at_line(line.number, "pose " + base::quoted(line.key) +
                                    ": expected a unit behind the positions, rad or deg (m or mm), "
                                    "found " +
                                    base::quoted(unit));
  }
  for (double& each : row.value().numbers) {
    each = base::convert(each, unit, length ? "m" : "rad").value();
  }
  return std::pair(std::string(line.key), std::move(row.value().numbers));
}

}  // namespace

std::string to_motion_text(std::string_view name, const TaughtSamples& samples) {
  std::string text =
      "# A taught motion: of each sample the time [s] and the positions [rad] of the joints.\n";
  text += "motion: " + std::string(name) + "\njoints: " + std::to_string(samples.axes) +
          "\nsamples: " + std::to_string(samples.times_s.size()) + "\n";
  for (std::size_t i = 0; i < samples.times_s.size(); ++i) {
    char time[32];
    std::snprintf(time, sizeof time, "%.6f: ", samples.times_s[i] - samples.times_s.front());
    text += time + row_text(std::span(samples.positions).subspan(i * samples.axes, samples.axes)) +
            "\n";
  }
  return text;
}

Result<TaughtSamples> read_motion_text(std::string_view text, std::size_t joints) {
  const std::vector<Line> lines = lines_of(text);
  TaughtSamples samples{joints, {}, {}};
  Head head;
  for (const Line& line : lines) {
    const auto of_head = head.take(line);
    if (!of_head) return Error{of_head.error()};
    if (head.joints != 0 && head.joints != joints) {
      return at_line(line.number, "the motion has " + std::to_string(head.joints) +
                                      " joints, the robot has " + std::to_string(joints));
    }
    if (of_head.value()) continue;
    if (const auto taken = take_sample(line, samples); !taken) return Error{taken.error()};
  }
  const std::size_t found = samples.times_s.size();
  const std::size_t last = lines.empty() ? 1 : lines.back().number;
  if (head.samples == 0) return at_line(last, "expected a line such as samples: 100, found none");
  if (found != head.samples) {
    return at_line(last, "the file has " + std::to_string(found) + " samples, it says " +
                             std::to_string(head.samples) + ": it was cut off or edited");
  }
  return samples;
}

std::string to_pose_text(const Poses& poses, std::string_view unit) {
  const bool length = unit == "m" || unit == "mm";
  std::string text = "# Poses of the robot: a name, the positions of all joints, their unit.\n";
  for (const auto& [name, positions] : poses) {
    std::vector<double> numbers;
    for (const double each : positions) {
      numbers.push_back(base::convert(each, length ? "m" : "rad", unit).value());
    }
    text += name + ": " + row_text(numbers) + " " + std::string(unit) + "\n";
  }
  return text;
}

Result<Poses> read_pose_text(std::string_view text, std::size_t joints) {
  Poses poses;
  std::string mistakes;
  const auto add = [&](const std::string& mistake) {
    mistakes += (mistakes.empty() ? "" : "\n") + mistake;
  };
  for (const Line& line : lines_of(text)) {
    auto pose = pose_in(line, joints);
    if (!pose) {
      add(pose.error());
    } else if (!poses.insert(std::move(pose.value())).second) {
      add(at_line(line.number, "a second pose " + base::quoted(line.key)).message);
    }
  }
  if (!mistakes.empty()) return Error{mistakes};
  return poses;
}

bool is_taught_name(std::string_view name) {
  const auto fits = [](char letter) {
    const bool word = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
    return word || (letter >= '0' && letter <= '9') || letter == '_' || letter == '-';
  };
  return !name.empty() && name.size() <= kLongestName && std::ranges::all_of(name, fits);
}

}  // namespace armature::controllers
