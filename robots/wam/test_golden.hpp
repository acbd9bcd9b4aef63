// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/can/frame.hpp"
#include "robots/wam/puck_protocol.hpp"

namespace armature::wam {

/// A line of testdata/can_golden.yaml.
struct GoldenFrame {
  std::string name;
  can::Frame frame;
  Address address;
};

inline std::vector<GoldenFrame> golden_frames() {
  static const std::regex kLine(
      R"re(\s*- \{name: "(.*)", id: 0x(\w+), from: (\d+), to: (\d+), group: (\w+), data: "([^"]*)".*)re");
  std::ifstream file(ROBOT_FOLDER "/testdata/can_golden.yaml");
  std::vector<GoldenFrame> frames;
  for (std::string line; std::getline(file, line);) {
    std::smatch parts;
    if (!std::regex_match(line, parts, kLine)) continue;
    const std::string data = std::regex_replace(parts[6].str(), std::regex(" "), "");
    auto frame = can::parse_frame(parts[2].str() + "#" + data);
    EXPECT_TRUE(frame) << line;
    frames.push_back({parts[1],
                      frame.value(),
                      {std::stoi(parts[3]), std::stoi(parts[4]), parts[5].str() == "true"}});
  }
  return frames;
}

/// By the name of a property, what number it has from which firmware on; none: not any more.
using GoldenNumbers = std::map<std::string, std::map<int, std::optional<int>>>;

/// testdata/puck_properties.yaml, by the kind's name there.
inline std::map<std::string, GoldenNumbers> golden_numbers() {
  static const std::regex kKind(R"((\w+):\s*)");
  static const std::regex kProperty(R"re(\s*"(\w+)": \{(.*)\}\s*)re");
  static const std::regex kNumber(R"((\d+): (\w+))");
  std::ifstream file(ROBOT_FOLDER "/testdata/puck_properties.yaml");
  std::map<std::string, GoldenNumbers> kinds;
  std::string kind;
  for (std::string line; std::getline(file, line);) {
    std::smatch parts;
    if (std::regex_match(line, parts, kKind)) kind = parts[1];
    if (!std::regex_match(line, parts, kProperty)) continue;
    auto& numbers = kinds[kind][parts[1]];
    const std::string list = parts[2];
    for (std::sregex_iterator i(list.begin(), list.end(), kNumber), end; i != end; ++i) {
      const std::string number = (*i)[2];
      numbers[std::stoi((*i)[1])] =
          number == "null" ? std::nullopt : std::optional<int>(std::stoi(number));
    }
  }
  return kinds;
}

}  // namespace armature::wam
