// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/feed.hpp"

#include <utility>

#include "armature/component/ports/output_port.hpp"

namespace armature::ros2::internal {

void Feed::follow(component::InputPortBase& input, std::size_t capacity) {
  for (component::OutputPortBase* writer : input.writers()) follow(*writer, capacity);
}

void Feed::follow(component::OutputPortBase& output, std::size_t capacity) {
  taps_.push_back({&output.tap(capacity)});
}

std::optional<base::Time> Feed::take_before(base::Time end, types::Value& value) {
  Tapped* oldest = nullptr;
  for (Tapped& each : taps_) {
    if (!each.next) {
      component::TappedSample sample;
      if (!each.tap->take(sample)) continue;
      each.next = std::move(sample);
    }
    if (each.next->time >= end) continue;
    if (oldest == nullptr || each.next->time < oldest->next->time) oldest = &each;
  }
  if (oldest == nullptr) return std::nullopt;
  const component::TappedSample sample = *std::exchange(oldest->next, std::nullopt);
  const auto read =
      types::decode(value.type(), sample.value.data(), sample.value.size(), value.data());
  if (!read) return std::nullopt;
  return sample.time;
}

void Feed::skip() {
  component::TappedSample sample;
  for (Tapped& each : taps_) {
    each.next.reset();
    while (each.tap->take(sample)) continue;
    each.dropped = each.tap->dropped();
  }
}

std::uint64_t Feed::take_dropped() {
  std::uint64_t more = 0;
  for (Tapped& each : taps_)
    more += each.tap->dropped() - std::exchange(each.dropped, each.tap->dropped());
  return more;
}

}  // namespace armature::ros2::internal
