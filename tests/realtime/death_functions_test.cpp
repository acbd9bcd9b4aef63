// SPDX-License-Identifier: Apache-2.0
// What has to be done in real time for the case that the process dies: the cycles are told to a
// guardian, and who worked when it died is named.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <unistd.h>

#include "armature/can/bus_server.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/component/host.hpp"
#include "armature/controllers/base/guarded_bus.hpp"
#include "armature/exec/death.hpp"
#include "armature/guardian/guardian.hpp"
#include "armature/platform/clock.hpp"
#include "armature/testing/harness.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature {
namespace {

using namespace std::chrono_literals;
using guardian::Guardian;
using platform::monotonic_now;

bool comes_true(const std::function<bool()>& condition) {
  const base::Time end = monotonic_now() + 20s;
  while (!condition()) {
    if (monotonic_now() > end) return false;
  }
  return true;
}

/// A bus in real time that a guardian can reach, and nobody is on.
class RealtimeGuardian : public ::testing::Test {
 protected:
  RealtimeGuardian() {
    base::Diagnostics diagnostics;
    server_ = can::BusServer::open(bus_, path_, diagnostics);
    EXPECT_NE(server_, nullptr) << diagnostics.to_text();
    if (server_) thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  guardian::Orders orders(base::Duration period) const {
    guardian::Orders made;
    made.bus = "virtual:" + path_;
    made.bit_rate = 1'000'000;
    made.period = period;
    made.safe = {can::data_frame(0x101, {0x80})};
    return made;
  }
  std::unique_ptr<Guardian> start(base::Duration period) const {
    auto started = Guardian::start(orders(period));
    EXPECT_TRUE(started) << started.error();
    return started ? std::move(started).value() : nullptr;
  }

  static constexpr base::Duration kLong = 20s;  ///< in which a cycle is run on any machine
  static constexpr base::Duration kShort = 2ms;

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      server_->take();
      bus_.advance_to(monotonic_now());
      server_->give();
      server_->wait_until(monotonic_now() + 1ms);
    }
  }

  const std::string path_ = ::testing::TempDir() + "armature-guarded-" + std::to_string(::getpid());
  can::VirtualBus bus_{"bus", 1'000'000, monotonic_now};
  std::unique_ptr<can::BusServer> server_;
  std::jthread thread_;
};

TEST_F(RealtimeGuardian, IsToldOfEachCycleAndOfTheirEnd) {
  const auto guardian = start(kLong);
  ASSERT_NE(guardian, nullptr);
  bool acted = false;
  expect_realtime("Guardian::beat", [&] {
    acted = acted || guardian->beat(monotonic_now()) == Guardian::Finding::kActed;
  });
  EXPECT_FALSE(acted);
  expect_realtime("Guardian::rest", [&] { guardian->rest(); });
}

TEST_F(RealtimeGuardian, ThatHasActedIsHeardInRealTimeToo) {
  const auto guardian = start(kShort);
  ASSERT_NE(guardian, nullptr);
  EXPECT_TRUE(comes_true([&] {
    std::this_thread::sleep_for(20ms);
    return guardian->beat(monotonic_now()) == Guardian::Finding::kActed;
  }));
  Guardian::Finding finding{};
  expect_realtime("Guardian::beat, after it has acted",
                  [&] { finding = guardian->beat(monotonic_now()); });
  EXPECT_EQ(finding, Guardian::Finding::kActed);
}

/// A component whose bus is guarded if its property says so.
class Guarded final : public component::Component {
 public:
  using Component::Component;
  controllers::GuardedBus bus{this};
};

TEST_F(RealtimeGuardian, OfAComponentsBusThatIsThereOrNotWanted) {
  for (const std::string wish : {"on", "off"}) {
    testing::Harness bench(std::make_unique<Guarded>("Host"));
    bench.set("guardian", wish);
    controllers::GuardedBus& bus = static_cast<Guarded&>(bench.component()).bus;
    ASSERT_TRUE(bus.start(orders(kLong)));
    EXPECT_FALSE(bus.complains()) << bus.said();
    EXPECT_EQ(bus.said().empty(), wish == "off");
    bool wrong = false;
    expect_realtime("GuardedBus::beat",
                    [&] { wrong = wrong || bus.beat(monotonic_now()).has_value(); });
    EXPECT_FALSE(wrong);
    expect_realtime("GuardedBus::rest", [&] { bus.rest(); });
  }
}

TEST_F(RealtimeGuardian, OfAComponentsBusSaysInRealTimeWhyItSwitchedTheDrivesOff) {
  testing::Harness bench(std::make_unique<Guarded>("Host"));
  controllers::GuardedBus& bus = static_cast<Guarded&>(bench.component()).bus;
  ASSERT_TRUE(bus.start(orders(kShort)));
  ASSERT_FALSE(bus.complains()) << bus.said();
  std::optional<component::Reason> why;
  EXPECT_TRUE(comes_true([&] {
    why = bus.beat(monotonic_now());
    std::this_thread::sleep_for(20ms);
    return why.has_value();
  }));
  expect_realtime("GuardedBus::beat, after its guardian has acted",
                  [&] { why = bus.beat(monotonic_now()); });
  ASSERT_TRUE(why);
  EXPECT_EQ(why->view().find("its guardian has switched the drives off"), 0u) << why->view();
  expect_realtime("GuardedBus::rest", [&] { bus.rest(); });
}

/// Names itself, as the signal handler would if it died.
class Dying final : public component::Component {
 public:
  using Component::Component;
  platform::Death death;

 private:
  void on_update() override { exec::name_worker(death); }
};

TEST(RealtimeFunctions, NameOfAWorker) {
  platform::Death of_nobody;
  expect_realtime("exec::name_worker", [&] { exec::name_worker(of_nobody); });
  EXPECT_STREQ(of_nobody.worker, "");
  testing::Harness bench(std::make_unique<Dying>("Dying"));
  ASSERT_TRUE(bench.start()) << bench.reason();
  const testing::RealtimeGuard guard;
  bench.run_cycles(100);
  EXPECT_EQ(guard.violations(), 0u) << guard.report();
  const auto& death = static_cast<Dying&>(bench.component()).death;
  EXPECT_STREQ(death.worker, "Dying");
  EXPECT_EQ(death.workplace, &component::Host::context(bench.component()));
}

}  // namespace
}  // namespace armature
