// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/can/bus_link.hpp"
#include "armature/can/host_wire.hpp"
#include "armature/platform/clock.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402/emulated_bus.hpp"
#include "drives/cia402/prepare_drive.hpp"

// Emulated drives in a process of their own and a host, on the interfaces of
// scripts/test-socketcan. Time there is counted in instructions, so it is the same for all runs:
// this tests 500 Hz, whatever else the machine does.

namespace armature::cia402 {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kDrives = 7;
constexpr base::Duration kPeriod = 2ms;
constexpr int kCycles = 500;

struct Interfaces {
  const char* drives;
  const char* host;
};

/// A process that is killed at the end.
class DrivesProcess {
 public:
  explicit DrivesProcess(const char* interface) : process_(::fork()) {
    if (process_ == 0) run(interface);
  }
  DrivesProcess(const DrivesProcess&) = delete;
  DrivesProcess& operator=(const DrivesProcess&) = delete;
  ~DrivesProcess() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

 private:
  [[noreturn]] static void run(const char* interface) {
    EmulatedBus::Config config;
    config.name = interface;
    config.bit_rate = can::kTimelessBitRate;
    config.drives = kDrives;
    config.clock = platform::monotonic_now;
    config.begin = platform::monotonic_now();
    auto drives = EmulatedBus::make(config);
    base::Diagnostics diagnostics;
    const auto wire = can::make_interface_wire(drives.value()->bus(), interface, diagnostics);
    while (wire != nullptr) {
      wire->take();
      const base::Time now = platform::monotonic_now();
      drives.value()->advance_to(now);
      wire->give();
      wire->wait_until(std::min(drives.value()->bus().next_event().value_or(now + 1ms), now + 1ms));
    }
    ::_exit(1);
  }

  const pid_t process_;
};

class DrivesOnCan : public ::testing::TestWithParam<Interfaces> {
 protected:
  void SetUp() override {
    base::Diagnostics diagnostics;
    ASSERT_TRUE(link.open({}, diagnostics)) << diagnostics.to_text();
    ASSERT_TRUE(is_there()) << "the drives answer";
    std::vector<DriveConfig> configs;
    for (std::size_t i = 0; i < kDrives; ++i) {
      DriveWish wish;
      wish.node = static_cast<canopen::NodeId>(i + 1);
      wish.name = "J" + std::to_string(i + 1);
      wish.cycle = kPeriod;
      canopen::SdoChannel channel(link, wish.node);
      const auto config = prepare_drive(channel, wish, diagnostics);
      ASSERT_TRUE(config) << diagnostics.to_text();
      configs.push_back(*config);
    }
    group = std::make_unique<DriveGroup>(std::move(DriveGroup::make(configs)).value());
    link.bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
    begin = link.now() + kPeriod;
  }
  /// Whether the other process has opened its end within 5 s.
  bool is_there() {
    canopen::SdoChannel channel(link, kDrives, {}, 100ms);
    for (int i = 0; i < 50; ++i) {
      if (channel.read({0x1000, 0}, canopen::DataType::kUnsigned32)) return true;
    }
    return false;
  }
  void cycle() {
    platform::sleep_until(begin + ++cycles * kPeriod);
    can::Arrival arrival;
    while (link.bus().receive(arrival) == can::ReceiveStatus::kReceived) group->take(arrival);
    refused += group->step(link.bus(), link.now());
  }
  bool all_enabled() const {
    for (std::size_t i = 0; i < kDrives; ++i) {
      if (!group->state(i).enabled()) return false;
    }
    return true;
  }

  DrivesProcess process{GetParam().drives};
  can::BusLink link{GetParam().host, 1'000'000};
  std::unique_ptr<DriveGroup> group;
  base::Time begin{};
  int cycles = 0;
  std::size_t refused = 0;
};

TEST_P(DrivesOnCan, SevenFollowPositionsFiveHundredTimesASecond) {
  for (int i = 0; i < 10; ++i) cycle();
  for (std::size_t i = 0; i < kDrives; ++i) group->set_goal(i, PowerGoal::kEnabled);
  for (int i = 0; i < 50 && !all_enabled(); ++i) cycle();
  ASSERT_TRUE(all_enabled());
  const int first = cycles;
  double target = 0.0;
  int silent = 0;
  while (cycles < first + kCycles) {
    target += 0.001;
    for (std::size_t i = 0; i < kDrives; ++i) group->set_target(i, target);
    cycle();
    for (std::size_t i = 0; i < kDrives; ++i) silent += group->state(i).silent_cycles > 0 ? 1 : 0;
  }
  EXPECT_LT(link.now(), begin + (cycles + 1) * kPeriod);
  EXPECT_EQ(refused, 0u);
  EXPECT_EQ(silent, 0);
  for (std::size_t i = 0; i < kDrives; ++i) {
    EXPECT_TRUE(group->state(i).enabled());
    EXPECT_NEAR(group->state(i).position, target, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernel, DrivesOnCan,
                         ::testing::Values(Interfaces{"vcan0", "vcan0"},
                                           Interfaces{"can0", "can1"}),
                         [](const auto& test) { return std::string(test.param.host); });

}  // namespace
}  // namespace armature::cia402
