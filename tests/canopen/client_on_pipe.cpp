// SPDX-License-Identifier: Apache-2.0
// A host of ours with a device of others on standard input and output: uses each service once, and
// says on standard error what came of it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/can/link.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/platform/clock.hpp"
#include "drives/canopen/emergency.hpp"
#include "drives/canopen/heartbeat.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/canopen/sync.hpp"
#include "drives/cia402/pipe_wire.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using canopen::DataType;

constexpr canopen::NodeId kNode = 9;
constexpr base::Duration kPatience = 10s;

/// A station on a bus whose other end are pipes.
class PipeLink final : public can::Link {
 public:
  PipeLink() { static_cast<void>(open({}, diagnostics_)); }
  can::Bus& bus() override { return station_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override {
    return station_.open(options, diagnostics);
  }
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override { return platform::monotonic_now(); }
  void wait_for_news(base::Time deadline) override {
    const std::uint64_t before = station_.counters().received;
    while (now() < deadline && station_.counters().received == before) {
      carry();
      wire_.wait_until(std::min(deadline, now() + base::Duration(1ms)));
    }
  }
  void carry() {
    wire_.take();
    bus_.advance_to(now());
    wire_.give();
  }

 private:
  can::VirtualBus bus_{"pipe", can::kTimelessBitRate, platform::monotonic_now};
  cia402::PipeWire wire_{bus_};
  can::VirtualStation& station_ = bus_.add_station("host");
  base::Diagnostics diagnostics_;
};

void say(const char* what, const std::string& text) {
  std::fprintf(stderr, "%s: %s\n", what, text.c_str());
}

template <typename T>
T require(const char* what, base::Result<T> result) {
  if (result) return std::move(result).value();
  say(what, "failed: " + result.error());
  std::exit(1);
}
void require(const char* what, const base::Result<void>& result) {
  if (result) return;
  say(what, "failed: " + result.error());
  std::exit(1);
}

/// The next frame that `wanted` says yes to.
template <typename Wanted>
can::Frame await(PipeLink& link, const char* what, Wanted wanted) {
  const base::Time deadline = link.now() + kPatience;
  while (link.now() < deadline) {
    can::Arrival arrival;
    while (link.bus().receive(arrival) == can::ReceiveStatus::kReceived) {
      if (wanted(arrival.frame)) return arrival.frame;
    }
    link.wait_for_news(deadline);
  }
  say(what, "failed: it did not come");
  std::exit(1);
}

void use_sdo(canopen::SdoChannel& channel) {
  say("vendor",
      std::to_string(require("vendor", channel.read({0x1018, 1}, DataType::kUnsigned32))));
  const auto text = require("text", channel.upload({0x2000, 0}));
  say("text", std::string(text.begin(), text.end()));
  const std::string written = "written by the host of another program";
  require("write text",
          channel.download({0x2000, 0}, std::vector<std::uint8_t>(written.begin(), written.end())));
  require("write number", channel.write({0x2001, 0}, DataType::kInteger32, -123456));
  say("number", std::to_string(require("number", channel.read({0x2001, 0}, DataType::kInteger32))));
  const auto missing = channel.read({0x3000, 0}, DataType::kUnsigned8);
  say("missing", missing ? "is there" : missing.error());
}

void use_pdos(PipeLink& link, canopen::SdoChannel& channel) {
  const auto transmit =
      require("TPDO", canopen::read_pdo(channel, canopen::PdoDirection::kTransmit, 1));
  for (const auto& object : transmit.objects) {
    say("mapped", to_text(object.address) + " " + std::to_string(object.bits));
  }
  link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, kNode));
  await(link, "start", [](const can::Frame& frame) {
    return frame.id == canopen::cob_id::heartbeat(kNode) &&
           canopen::parse_heartbeat(frame) == canopen::NmtState::kOperational;
  });
  link.bus().send(canopen::SyncProducer().step());
  std::vector<std::uint64_t> values(transmit.objects.size());
  await(link, "PDO", [&](const can::Frame& frame) { return unpack(transmit, frame, values); });
  for (const std::uint64_t value : values) say("PDO", std::to_string(value));
  const canopen::Pdo receive{.cob_id = canopen::cob_id::receive_pdo(1, kNode),
                             .valid = true,
                             .objects = {{{0x2002, 0}, 16}}};
  link.bus().send(pack(receive, std::vector<std::uint64_t>{0xbeef}));
}

int run() {
  PipeLink link;
  canopen::HeartbeatConsumer heartbeats;
  heartbeats.watch(kNode, kPatience);
  const can::Frame heartbeat = await(link, "heartbeat", [](const can::Frame& frame) {
    return frame.id == canopen::cob_id::heartbeat(kNode);
  });
  heartbeats.take(heartbeat, link.now());
  say("heartbeat", to_text(heartbeats.node(kNode).state));
  canopen::SdoChannel channel(link, kNode, {}, kPatience);
  use_sdo(channel);
  use_pdos(link, channel);
  const can::Frame emergency = await(link, "emergency", [](const can::Frame& frame) {
    return canopen::parse_emergency(frame).has_value();
  });
  say("emergency", to_text(*canopen::parse_emergency(emergency)));
  link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStop, kNode));
  await(link, "stop", [](const can::Frame& frame) {
    return canopen::parse_heartbeat(frame) == canopen::NmtState::kStopped;
  });
  say("end", "all done");
  return 0;
}

}  // namespace
}  // namespace armature

int main() { return armature::run(); }
