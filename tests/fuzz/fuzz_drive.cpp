// SPDX-License-Identifier: Apache-2.0
// An emulated drive and a host's group with frames of anybody: PDOs, EMCY, NMT, SYNC, heartbeats,
// SDO. The axis stays finite, and the host resets no fault.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/can/virtual_bus.hpp"
#include "drives/canopen/little_endian.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402/emulated_drive.hpp"
#include "drives/cia402/objects.hpp"

namespace {

using namespace armature;

void refuse(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

/// What is packed is unpacked again, whatever the mapping.
void pack_and_unpack(std::span<const std::uint8_t> input) {
  if (input.size() < 10) return;
  canopen::Pdo pdo{.cob_id = 0x181, .valid = true, .objects = {}};
  const std::uint64_t content = canopen::load(input.first(8));
  std::vector<std::uint64_t> values;
  for (const std::uint8_t bits : input.subspan(8, std::min<std::size_t>(input.size() - 8, 80))) {
    pdo.objects.push_back({{0x2000, 0}, bits});
    values.push_back(content & canopen::low_bits(bits));
  }
  const can::Frame frame = canopen::pack(pdo, values);
  std::vector<std::uint64_t> read(values.size());
  const bool fits = canopen::check_mapping(pdo.objects).ok();
  if (fits && (!canopen::unpack(pdo, frame, read) || read != values)) refuse("a PDO has changed");
}

cia402::DriveGroup make_group() {
  using namespace cia402;
  DriveConfig config{
      .node = 1,
      .name = "J1",
      .mode = Mode::kCyclicPosition,
      .scaling = {},
      .receive = {{.cob_id = 0x201,
                   .valid = true,
                   .objects = {{object::kControlWord, 16}, {object::kTargetPosition, 32}}}},
      .transmit = {{.cob_id = 0x181,
                    .valid = true,
                    .objects = {{object::kStatusWord, 16}, {object::kPosition, 32}}}},
      .heartbeat_timeout = std::chrono::milliseconds(10)};
  return std::move(DriveGroup::make({config})).value();
}

/// Twelve bytes are a frame and the time until the next.
struct Network {
  Network() {
    base::Diagnostics none;
    static_cast<void>(host.open({}, none) && ours.open({}, none) && theirs.open({}, none));
  }
  void take(std::span<const std::uint8_t> bytes) {
    can::Frame frame = can::data_frame(
        static_cast<std::uint32_t>(canopen::load(bytes.first(2)) & can::Frame::kMostStandard),
        bytes.subspan(4));
    frame.size = bytes[2] % 9;
    host.send(frame);
    now += base::Duration(bytes[3] * 50'000);
    bus.advance_to(now);
    drive.advance_to(now);
    can::Arrival arrival;
    while (ours.receive(arrival) == can::ReceiveStatus::kReceived) {
      group.take(arrival);
      static_cast<void>(canopen::parse_emergency(arrival.frame));
    }
    group.step(ours, now);
    while (host.receive(arrival) == can::ReceiveStatus::kReceived) {
      const bool target = arrival.frame.id == 0x201 && arrival.frame.size == 6;
      if (target && (arrival.frame.data[0] & 0x80) != 0) refuse("the host has reset a fault");
    }
    if (!std::isfinite(drive.axis().position())) refuse("the axis has left the numbers");
  }

  base::Time now{};
  can::VirtualBus bus{"can0", 1'000'000, [this] { return now; }};
  can::VirtualStation& host = bus.add_station("host");
  can::VirtualStation& ours = bus.add_station("ours");
  can::VirtualStation& theirs = bus.add_station("drive");
  cia402::EmulatedDrive drive{{}, theirs, now};
  cia402::DriveGroup group = make_group();
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span input(data, std::min<std::size_t>(size, 1200));
  pack_and_unpack(input);
  Network network;
  for (; input.size() >= 12; input = input.subspan(12)) network.take(input.first(12));
  return 0;
}
