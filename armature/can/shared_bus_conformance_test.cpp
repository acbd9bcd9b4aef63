// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "armature/can/internal/conformance.hpp"
#include "armature/can/internal/server_rig.hpp"
#include "armature/can/shared_bus.hpp"

namespace armature::can::internal {
namespace {

/// Two clients of a bus in real time, and one beside them who only listens.
class SharedRig final : public BusRig {
 public:
  SharedRig() {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(listener_.open({.receive_capacity = 1000}, diagnostics)) << diagnostics.to_text();
  }
  Bus& first() override { return first_; }
  Bus& second() override { return second_; }

  void settle() override {
    EXPECT_TRUE(wait_for([this] { return heard() >= on_wire(first_) + on_wire(second_); }));
    served_.with([](VirtualBus&, BusServer&) {});
  }
  bool wait_for(const std::function<bool()>& condition) override {
    return comes_true_in_time(condition);
  }
  bool force_bus_off() override {
    constexpr std::uint32_t kDoomed = 0x7f0;
    served_.with([](VirtualBus& bus, BusServer&) {
      bus.corrupt_next(32, Filter{.id = kDoomed, .mask = Frame::kMostStandard});
    });
    return first_.send(data_frame(kDoomed, {})) == SendStatus::kSent;
  }

 private:
  static std::uint64_t on_wire(const Bus& bus) {
    const BusCounters counters = bus.counters();
    return counters.sent - counters.discarded;
  }
  std::uint64_t heard() {
    Arrival arrival;
    while (listener_.receive(arrival) == ReceiveStatus::kReceived) continue;
    return listener_.counters().received;
  }

  TestFolder folder_;
  ServedBus served_{folder_.file("bus")};
  SharedBus first_{folder_.file("bus"), 1'000'000};
  SharedBus second_{folder_.file("bus"), 1'000'000};
  SharedBus listener_{folder_.file("bus"), 1'000'000};
};

INSTANTIATE_TEST_SUITE_P(Shared, BusConformance,
                         testing::Values(BusImplementation{
                             "shared", [] { return std::make_unique<SharedRig>(); }}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace armature::can::internal
