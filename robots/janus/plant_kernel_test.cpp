// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <chrono>
#include <memory>
#include <optional>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/can/bus_link.hpp"
#include "armature/platform/clock.hpp"
#include "robots/janus/aic/aic_driver.hpp"
#include "robots/janus/janus_urdf.hpp"
#include "robots/janus/plant.hpp"

// The plant in a process of its own and a host, on the interfaces of scripts/test-socketcan. Time
// there is counted in instructions, so it is the same for all runs: this tests a rate and the
// driver's own timeouts, whatever else the machine does.

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

struct Interfaces {
  const char* plant;
  const char* host;
};

/// A process that is killed at the end.
class PlantProcess {
 public:
  explicit PlantProcess(const char* interface) : process_(::fork()) {
    if (process_ != 0) return;
    auto plant =
        Plant::start({.urdf = kJanusUrdf, .urdf_name = "janus.urdf", .interface = interface});
    while (plant) ::pause();
    ::_exit(1);
  }
  PlantProcess(const PlantProcess&) = delete;
  PlantProcess& operator=(const PlantProcess&) = delete;
  ~PlantProcess() {
    send(SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  void send(int signal) const { ::kill(process_, signal); }

 private:
  const pid_t process_;
};

class PlantOnCan : public ::testing::TestWithParam<Interfaces> {
 protected:
  void SetUp() override {
    const AicDriver::Config config{.cards = {1, 2}, .mode = AicMode::kSynchronous};
    base::Diagnostics diagnostics;
    ASSERT_TRUE(link.open(AicDriver::bus_options(config), diagnostics)) << diagnostics.to_text();
    driver.emplace(AicDriver::make(link.bus(), config).value());
    driver->start(link.now());
    ASSERT_TRUE(comes_true([this] { return read(); })) << "the plant answers";
  }
  /// Whether both cards have answered.
  bool read() {
    driver->begin_reading(link.now());
    while (driver->poll(link.now()) == AicReading::kWaiting) link.wait_for_news(driver->deadline());
    return driver->reading() == AicReading::kComplete;
  }
  template <typename Condition>
  static bool comes_true(const Condition& condition) {
    const base::Time end = platform::monotonic_now() + 5s;
    while (!condition()) {
      if (platform::monotonic_now() > end) return false;
    }
    return true;
  }
  const SensorReport& report(std::size_t card) { return driver->card(card).report; }
  /// Joint 1 turns.
  bool turn() {
    driver->set_watchdog(0, 5s);
    driver->set_watchdog(1, 5s);
    driver->command(0, AicCommand::kActuatorOff);
    driver->command(0, AicCommand::kActuatorOn);
    return comes_true([this] {
      driver->set_motor(0, 0.3);
      driver->send_motors();
      return read() && report(0).actuator_on && driver->card(0).counts > 5000;
    });
  }

  PlantProcess plant{GetParam().plant};
  can::BusLink link{GetParam().host, kBitRate};
  std::optional<AicDriver> driver;
};

TEST_P(PlantOnCan, AHostOnTheOtherEndTurnsAJoint) {
  EXPECT_TRUE(turn());
  EXPECT_FALSE(report(1).actuator_on);
  EXPECT_TRUE(driver->card(0).counts_exact);
}

TEST_P(PlantOnCan, EachOfAThousandCyclesInASecondHasItsAnswers) {
  constexpr base::Duration kPeriod = 1ms;
  constexpr int kCycles = 1000;
  const base::Time begin = link.now();
  int complete = 0;
  for (int i = 1; i <= kCycles; ++i) {
    platform::sleep_until(begin + i * kPeriod);
    complete += read() ? 1 : 0;
    driver->send_motors();
  }
  EXPECT_EQ(complete, kCycles);
  EXPECT_LT(link.now(), begin + (kCycles + 1) * kPeriod);
}

TEST_P(PlantOnCan, WithoutItsHostTheCardsWatchdogTrips) {
  ASSERT_TRUE(turn());
  driver->set_watchdog(0, 200ms);
  platform::sleep_until(platform::monotonic_now() + 1s);  // the host's silence is what is tested
  ASSERT_TRUE(comes_true([this] { return read(); }));
  EXPECT_TRUE(report(0).watchdog_tripped);
  EXPECT_FALSE(report(0).actuator_on);
}

TEST_P(PlantOnCan, AStoppedPlantIsSilentAndItsWatchdogHasTrippedWhenItGoesOn) {
  ASSERT_TRUE(turn());
  driver->set_watchdog(0, 200ms);
  ASSERT_TRUE(comes_true([this] { return read(); }));
  plant.send(SIGSTOP);
  EXPECT_TRUE(comes_true([this] { return !read(); }));
  EXPECT_TRUE(comes_true([this] { return driver->silent(0, link.now()); }));
  plant.send(SIGCONT);
  ASSERT_TRUE(comes_true([this] { return read(); }));
  EXPECT_TRUE(report(0).watchdog_tripped);
  EXPECT_FALSE(report(0).actuator_on);
}

INSTANTIATE_TEST_SUITE_P(Kernel, PlantOnCan,
                         ::testing::Values(Interfaces{"vcan0", "vcan0"},
                                           Interfaces{"can0", "can1"}),
                         [](const auto& test) { return std::string(test.param.host); });

}  // namespace
}  // namespace armature::janus
