// SPDX-License-Identifier: Apache-2.0
#include "armature/can/bus.hpp"

#include <algorithm>

namespace armature::can {
namespace {

void check_filter(const std::string& name, const Filter& filter, base::Diagnostics& diagnostics) {
  const std::uint32_t most = filter.extended ? Frame::kMostExtended : Frame::kMostStandard;
  if (filter.id <= most && filter.mask <= most) return;
  diagnostics.error({},
                    "bus '" + name + "': a filter's identifier and mask have at most " +
                        (filter.extended ? "29" : "11") + " bits, but " +
                        std::to_string(filter.id) + " and " + std::to_string(filter.mask) +
                        " are given",
                    filter.extended ? "use at most 0x1fffffff"
                                    : "use at most 0x7ff, or make the filter extended");
}

void check_capacity(const std::string& name, const char* what, std::size_t capacity,
                    base::Diagnostics& diagnostics) {
  constexpr std::size_t kMost = 1 << 20;
  if (capacity >= 1 && capacity <= kMost) return;
  diagnostics.error({},
                    "bus '" + name + "': " + what + " is expected to be 1 to " +
                        std::to_string(kMost) + " frames, but is " + std::to_string(capacity),
                    "leave it out for the default");
}

}  // namespace

const char* to_text(SendStatus status) {
  switch (status) {
    case SendStatus::kSent:
      return "sent";
    case SendStatus::kQueueFull:
      return "queue full";
    case SendStatus::kBusOff:
      return "bus-off";
    case SendStatus::kDown:
      return "down";
    case SendStatus::kInvalid:
      return "invalid frame";
  }
  return "?";
}

const char* to_text(BusState state) {
  switch (state) {
    case BusState::kClosed:
      return "closed";
    case BusState::kActive:
      return "error active";
    case BusState::kPassive:
      return "error passive";
    case BusState::kBusOff:
      return "bus-off";
    case BusState::kDown:
      return "down";
  }
  return "?";
}

bool check_options(const std::string& name, const BusOptions& options,
                   base::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  for (const Filter& filter : options.filters) check_filter(name, filter, diagnostics);
  check_capacity(name, "send_capacity", options.send_capacity, diagnostics);
  check_capacity(name, "receive_capacity", options.receive_capacity, diagnostics);
  return diagnostics.error_count() == before;
}

bool passes(const BusOptions& options, const Frame& frame) {
  if (frame.kind == FrameKind::kError) return options.error_frames;
  return options.filters.empty() || std::ranges::any_of(options.filters, [&](const Filter& filter) {
           return filter.passes(frame);
         });
}

}  // namespace armature::can
