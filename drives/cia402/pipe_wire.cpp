// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/pipe_wire.hpp"

#include <cstdio>
#include <utility>

#include "armature/base/diagnostic.hpp"
#include "armature/platform/clock.hpp"
#include "armature/platform/terminal.hpp"

namespace armature::cia402 {
namespace {

constexpr std::size_t kMostRead = 4096;
/// A line of a frame is far shorter; what is longer is thrown away.
constexpr std::size_t kMostLine = 4096;

}  // namespace

PipeWire::PipeWire(can::VirtualBus& bus) : station_(bus.add_station("pipe")) {
  base::Diagnostics none;  // a new station with these options always opens
  static_cast<void>(station_.open({.send_capacity = 1024, .receive_capacity = 1024}, none));
}

void PipeWire::take() {
  while (!ended_ && platform::wait_readable(platform::kStandardInput, {})) {
    const auto text = platform::read_some(platform::kStandardInput, kMostRead);
    if (!text) return;
    ended_ = text->empty();
    take_text(ended_ ? "\n" : *text);
  }
}

void PipeWire::take_text(const std::string& text) {
  for (const char c : text) {
    if (c != '\n') {
      if (rest_.size() < kMostLine) rest_ += c;
      continue;
    }
    const std::string line = std::exchange(rest_, {});
    if (line.empty()) continue;
    const auto frame = can::parse_frame(line);
    if (frame) {
      static_cast<void>(station_.send(frame.value()));
    } else {
      lines_.push_back(line);
    }
  }
}

void PipeWire::give() {
  can::Arrival arrival;
  bool any = false;
  while (station_.receive(arrival) == can::ReceiveStatus::kReceived) {
    const auto text = can::to_text(arrival.frame);
    std::printf("%.*s\n", static_cast<int>(text.view().size()), text.view().data());
    any = true;
  }
  if (any) std::fflush(stdout);
}

void PipeWire::wait_until(base::Time deadline) {
  if (ended_) {
    platform::sleep_until(deadline);
    return;
  }
  const base::Duration left = deadline - platform::monotonic_now();
  if (left > base::Duration{}) platform::wait_readable(platform::kStandardInput, left);
}

std::optional<std::string> PipeWire::take_line() {
  if (lines_.empty()) return std::nullopt;
  std::string line = std::move(lines_.front());
  lines_.pop_front();
  return line;
}

}  // namespace armature::cia402
