// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "armature/can/frame.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// A line of testdata/can_golden.yaml.
struct GoldenFrame {
  std::string name;
  can::Frame frame;
  Address address;
};

inline std::vector<GoldenFrame> golden_frames() {
  std::vector<GoldenFrame> frames;
  const YAML::Node file = YAML::LoadFile(ROBOT_FOLDER "/testdata/can_golden.yaml");
  for (const YAML::Node& line : file["frames"]) {
    const std::string identifier = line["id"].Scalar().substr(2);  // without 0x
    std::string data = line["data"].Scalar();
    std::erase(data, ' ');
    auto frame = can::parse_frame(identifier + "#" + data);
    EXPECT_TRUE(frame) << line;
    frames.push_back({line["name"].Scalar(),
                      frame.value(),
                      {line["from"].as<int>(), line["to"].as<int>(), line["group"].as<bool>()}});
  }
  return frames;
}

/// By the name of a property, what number it has from which firmware on; none: not any more.
using GoldenNumbers = std::map<std::string, std::map<int, std::optional<int>>>;

/// testdata/puck_properties.yaml, by the kind's name there.
inline std::map<std::string, GoldenNumbers> golden_numbers() {
  std::map<std::string, GoldenNumbers> kinds;
  for (const auto& kind : YAML::LoadFile(ROBOT_FOLDER "/testdata/puck_properties.yaml")) {
    if (!kind.second.IsMap()) continue;
    for (const auto& property : kind.second) {
      if (!property.second.IsMap()) continue;
      auto& numbers = kinds[kind.first.Scalar()][property.first.Scalar()];
      for (const auto& from : property.second) {
        numbers[from.first.as<int>()] =
            from.second.IsNull() ? std::nullopt : std::optional<int>(from.second.as<int>());
      }
    }
  }
  return kinds;
}

}  // namespace armature::wam
