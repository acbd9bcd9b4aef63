// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace armature::janus {

/// A card's book of encoder counts: those that no report has yet, and those in reports that wait to
/// be sent. What the bus throws away comes back, so that only a report that was acknowledged and
/// not received takes counts with it; its counter shows it.
class AicReportBook {
 public:
  /// How many reports may wait.
  static constexpr std::size_t kMost = 8;

  void add(std::int64_t counts) { unreported_ += counts; }

  /// For the next report: as many counts as fit into it, and its counter.
  std::int32_t counts() const;
  std::uint8_t counter() const { return counter_; }
  /// The next counter leaves out `count` reports that nobody made.
  void skip(int count);

  /// A frame with the counter and `counts` was handed to the bus; at most kMost wait.
  void hand_over(std::uint32_t id, std::int32_t counts);
  /// A frame was on the wire; it is the oldest one if that has its identifier.
  void acknowledge(std::uint32_t id);
  /// The bus has thrown away everything that waited.
  void take_back();

 private:
  struct Waiting {
    std::uint32_t id = 0;
    std::int32_t counts = 0;
    std::uint8_t counter = 0;
  };

  std::int64_t unreported_ = 0;
  std::uint8_t counter_ = 0;
  std::array<Waiting, kMost> waiting_{};
  std::size_t count_ = 0;
};

}  // namespace armature::janus
