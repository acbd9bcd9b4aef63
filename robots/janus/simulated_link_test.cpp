// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulated_link.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "robots/janus/aic/aic_driver.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

class LinkTest : public ::testing::TestWithParam<AicMode> {
 protected:
  /// A link that began at `begin`, and a driver that has started.
  void open(SimulatedLink::Time time, base::Time begin) {
    auto made = SimulatedLink::make({.urdf_file = ROBOT_FOLDER "/janus.urdf"}, time, begin);
    ASSERT_TRUE(made) << made.error();
    link = std::move(made).value();
    const AicDriver::Config config{.cards = {1, 2}, .mode = GetParam()};
    base::Diagnostics diagnostics;
    ASSERT_TRUE(link->open(AicDriver::bus_options(config), diagnostics)) << diagnostics.to_text();
    driver.emplace(AicDriver::make(link->bus(), config).value());
    driver->start(link->now());
  }
  AicReading read(base::Time cycle) {
    link->begin_cycle(cycle);
    driver->begin_reading(link->now());
    while (driver->poll(link->now()) == AicReading::kWaiting) {
      link->wait_for_news(driver->deadline());
    }
    return driver->reading();
  }

  std::unique_ptr<SimulatedLink> link;
  std::optional<AicDriver> driver;
};

TEST_P(LinkTest, BothCardsAnswerWhateverTheApplicationsClockSays) {
  const base::Time begin = base::Time{} + 1h;
  open(SimulatedLink::Time::kSimulated, begin);
  for (int k = 1; k <= 10; ++k) {
    const base::Time cycle = begin + k * 10ms;
    ASSERT_EQ(read(cycle), AicReading::kComplete);
    EXPECT_GT(driver->card(1).report_time, cycle);
    EXPECT_LT(driver->card(1).report_time, cycle + 1ms);
  }
}

TEST_P(LinkTest, InRealTimeItIsTheMonotonicClock) {
  const base::Time before = platform::monotonic_now();
  open(SimulatedLink::Time::kReal, before);
  // A machine that stands still for a moment spoils a reading, but not twenty.
  auto reading = AicReading::kWaiting;
  for (int k = 0; k < 20 && reading != AicReading::kComplete; ++k) {
    reading = read(platform::monotonic_now());
  }
  ASSERT_EQ(reading, AicReading::kComplete);
  EXPECT_GT(driver->card(0).report_time, before);
  EXPECT_LE(driver->card(1).report_time, platform::monotonic_now());
}

INSTANTIATE_TEST_SUITE_P(Modes, LinkTest,
                         ::testing::Values(AicMode::kSequential, AicMode::kSynchronous));

}  // namespace
}  // namespace armature::janus
