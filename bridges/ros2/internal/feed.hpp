// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "armature/component/observing/tap.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/types/type.hpp"

namespace armature::ros2::internal {

/// Every sample that is written to an input, or by an output: writers hand them over without
/// waiting, into a ring of fixed size.
/// @thread configuration to follow; then that of the component it is part of
class Feed {
 public:
  /// Follows all writers of `input`.
  void follow(component::InputPortBase& input, std::size_t capacity);
  void follow(component::OutputPortBase& output, std::size_t capacity);
  void end() { taps_.clear(); }

  bool connected() const { return !taps_.empty(); }
  /// The next sample that was written before `end`, its value in `value`.
  /// @return its time; nothing if there is none
  std::optional<base::Time> take_before(base::Time end, types::Value& value);
  /// Forgets what has come so far.
  void skip();
  /// Samples that found no room since this was asked last.
  std::uint64_t take_dropped();

 private:
  struct Tapped {
    component::Tap* tap;
    std::uint64_t dropped = 0;  ///< as seen last
    std::optional<component::TappedSample> next{};
  };
  std::vector<Tapped> taps_;
};

}  // namespace armature::ros2::internal
