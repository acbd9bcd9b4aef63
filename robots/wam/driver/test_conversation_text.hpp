// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "robots/wam/emulator/test_bench.hpp"

namespace armature::wam {

/// Says frames in words, for pucks and a board with these versions.
class ConversationText {
 public:
  ConversationText(int puck_version, int board_version)
      : puck_version_(puck_version), board_version_(board_version) {}

  /// A line: when it began [ms], who sent it to whom, the frame, what it says.
  std::string line(const can::WireEvent& event, base::Time begin) const {
    const Address address = address_of(event.frame).value();
    const double ms = std::chrono::duration<double, std::milli>(event.begin - begin).count();
    char text[96];
    std::snprintf(text, sizeof text, "%9.3f  %-6s  %-21s  ", ms, name(address.from).c_str(),
                  std::string(can::to_text(event.frame).view()).c_str());
    return text + words(event.frame, address);
  }
  std::string lines(const std::vector<can::WireEvent>& log, base::Time begin) const {
    std::string all;
    for (const can::WireEvent& event : log) all += line(event, begin) + '\n';
    return all;
  }

 private:
  static std::string name(int node) {
    if (node == kHostNode) return "host";
    return node == kBoardNode ? "board" : "puck" + std::to_string(node);
  }
  std::string words(const can::Frame& frame, const Address& address) const {
    const bool of_board =
        address.from == kBoardNode || (!address.group && address.to == kBoardNode);
    if (address.group && address.to == static_cast<int>(Group::kPositions)) {
      return "position " + std::to_string(parse_positions(frame).value().motor);
    }
    const bool to_host = address.group && address.to == static_cast<int>(Group::kReplies);
    const std::string whom =
        to_host ? "" : (address.group ? " to group " : " to node ") + std::to_string(address.to);
    if (frame.size == 8) {
      std::string all = "torques";
      const Torques torques = parse_torques(frame, frame.data[0] & 0x7f).value();
      for (const std::int16_t each : torques) all += ' ' + std::to_string(each);
      return all;
    }
    const Message message = parse_message(frame).value();
    const auto property = of_board && address.to != 0
                              ? property_of(PuckKind::kSafety, board_version_, message.number)
                              : property_of(PuckKind::kMotor, puck_version_, message.number);
    const std::string what = property ? to_text(*property) : std::to_string(message.number);
    const std::string value = message.set ? ' ' + std::to_string(message.value) : "";
    return (to_host ? "" : message.set ? "SET " : "GET ") + what + value + whom;
  }

  const int puck_version_;
  const int board_version_;
};

}  // namespace armature::wam
