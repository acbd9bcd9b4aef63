// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "armature/can/internal/conformance.hpp"
#include "armature/can/virtual_bus.hpp"

namespace armature::can::internal {
namespace {

class VirtualRig final : public BusRig {
 public:
  explicit VirtualRig(SendOrder order)
      : first_(bus_.add_station("first", order)), second_(bus_.add_station("second", order)) {}
  Bus& first() override { return first_; }
  Bus& second() override { return second_; }
  void settle() override {
    while (const auto event = bus_.next_event()) now_ = advance(*event);
  }
  bool force_bus_off() override {
    first_.force_bus_off();
    return true;
  }

 private:
  base::Time advance(base::Time to) {
    bus_.advance_to(to);
    return to;
  }

  base::Time now_{};
  VirtualBus bus_{"virtual", 1'000'000, [this] { return now_; }};
  VirtualStation& first_;
  VirtualStation& second_;
};

BusImplementation implementation(const char* name, SendOrder order) {
  return {name, [order] { return std::make_unique<VirtualRig>(order); }};
}

INSTANTIATE_TEST_SUITE_P(Virtual, BusConformance,
                         testing::Values(implementation("first", SendOrder::kFirst),
                                         implementation("most_urgent", SendOrder::kMostUrgent)),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace armature::can::internal
