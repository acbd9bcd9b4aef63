// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::replay {

/// Where two recordings differ.
struct Difference {
  std::string channel;  ///< `Component.Port`
  base::Time time{};
  std::uint32_t sequence = 0;  ///< of the channel's sample
  std::string was;             ///< JSON of the value, or in words that there is none
  std::string is;
};

/// A way of data between two ports, `Component.Port`. It is recorded under either name.
struct Flow {
  std::string from;
  std::string to;
};

/// What is compared, and what is known of it.
struct ComparisonOptions {
  base::Time until = base::Time::max();
  /// The recorder dropped samples, so that one that is missing says nothing.
  bool losses = false;
  bool times = true;                                ///< also when each sample was written
  const std::set<std::string>* channels = nullptr;  ///< only these; nullptr: all
};

/// What comparing found.
struct Comparison {
  std::uint64_t equal = 0;   ///< samples
  std::size_t channels = 0;  ///< with such samples
  std::uint64_t different = 0;
  std::uint64_t missing = 0;  ///< samples that only the replay has: nobody knows what they were
  std::vector<std::string> only_recorded;  ///< channels that the replay lacks
  std::vector<Difference> differences;     ///< the first of each channel that has one
  std::vector<std::string> compared;       ///< channels

  void add(Comparison other);
  /// The earliest difference. Of several at one time the one that no other one of them leads to, by
  /// ways on which nothing is known to be as it was; of a circle the first in `order`.
  /// @param order  components, writers before readers
  std::optional<Difference> first(const std::vector<Flow>& flows,
                                  const std::vector<std::string>& order) const;
};

/// Compares what was recorded with what a replay recorded, sample by sample: by their numbers, or
/// by their times in channels whose numbers come again; to the bit, but for what a NaN has beside
/// being one. Behind the end of a recording that was cut off nothing is compared.
Comparison compare(const record::McapRecording& was, const record::McapRecording& is,
                   const ComparisonOptions& options);

/// The component of a channel's name: `Arm.Joint1` of `Arm.Joint1.Position`.
std::string_view component_of(std::string_view channel);

}  // namespace armature::replay
