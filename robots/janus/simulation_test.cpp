// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/simulation.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/sim/encoder.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "robots/janus/aic/aic_driver.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kPan = 0;
constexpr std::size_t kTilt = 1;
constexpr base::Duration kPeriod = 10ms;

/// The bits of a standard data frame as ISO 11898 has them, from start of frame to the space behind
/// it; counted here once more, so that the times of the bus are not judged by its own arithmetic.
base::Duration time_on_wire(const can::Frame& frame) {
  std::vector<int> bits{0};
  const auto append = [&bits](std::uint32_t value, int count) {
    while (count-- > 0) bits.push_back(static_cast<int>(value >> count & 1u));
  };
  append(frame.id, 11);
  append(0, 3);  // RTR, IDE, r0
  append(frame.size, 4);
  for (const std::uint8_t byte : frame.bytes()) append(byte, 8);
  std::uint32_t checksum = 0;
  for (const int bit : bits) {
    const bool next = (checksum >> 14 & 1u) != static_cast<std::uint32_t>(bit);
    checksum = (checksum << 1 & 0x7fffu) ^ (next ? 0x4599u : 0u);
  }
  append(checksum, 15);
  int stuffed = 0;
  int run = 0;
  int last = -1;
  for (const int bit : bits) {
    run = bit == last ? run + 1 : 1;
    last = bit;
    if (run < 5) continue;
    ++stuffed;  // a bit of the other value, which begins the next run
    last = 1 - bit;
    run = 1;
  }
  constexpr int kTail = 1 + 2 + 7 + 3;  // CRC delimiter, acknowledgement, end, space
  return std::chrono::microseconds(static_cast<int>(bits.size()) + stuffed + kTail);
}

/// The robot with a host's station, and what was on the wire.
struct Robot {
  explicit Robot(const can::VirtualBus::Clock& clock = {})
      : simulation(
            Simulation::make({.head = {.urdf_file = ROBOT_FOLDER "/janus.urdf"}, .clock = clock})
                .value()) {
    base::Diagnostics diagnostics;
    can::BusOptions options;
    options.on_news = [this] {
      if (on_news) on_news();
    };
    EXPECT_TRUE(host.open(options, diagnostics)) << diagnostics.to_text();
    simulation->bus().set_tap([this](const can::WireEvent& event) {
      if (keeps_log) log.push_back(event);
    });
  }
  base::Time now() const { return simulation->now(); }
  void advance(base::Duration time) { simulation->advance_to(now() + time); }
  base::Duration wire_time() const {
    base::Duration sum{};
    for (const auto& event : log) sum += time_on_wire(event.frame);
    return sum;
  }

  std::unique_ptr<Simulation> simulation;
  can::VirtualStation& host = simulation->bus().add_station("host");
  std::function<void()> on_news;
  std::vector<can::WireEvent> log;
  bool keeps_log = true;
};

/// The robot with a driver, and both joints in motion.
struct Driven : Robot {
  explicit Driven(AicMode mode)
      : motor_frames(mode == AicMode::kSynchronous ? 1 : kJoints),
        driver(AicDriver::make(host, {.cards = {1, 2}, .mode = mode}).value()) {
    on_news = [this] { driver.poll(now()); };
    driver.start(now());
    advance(1ms);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      driver.command(joint, AicCommand::kActuatorOn);
      driver.command(joint, AicCommand::kBrakeRelease);
    }
    advance(kPeriod - 1ms);
  }
  /// Reads, computes the next motor values in no time, sends them; returns when they are there.
  void cycle(int number) {
    log.clear();
    const base::Time begin = now();
    driver.begin_reading(now());
    while (driver.reading() == AicReading::kWaiting)
      simulation->advance_to_next_event(begin + kPeriod);
    driver.set_motor(kPan, 0.2 * std::sin(0.05 * number));
    driver.set_motor(kTilt, 0.1 + 0.05 * std::sin(0.07 * number));
    driver.send_motors();
    const std::size_t before = log.size();
    while (log.size() < before + motor_frames) simulation->advance_to_next_event(begin + kPeriod);
  }
  base::Duration cycle_time() const { return log.back().end - log.front().begin; }

  const std::size_t motor_frames;
  AicDriver driver;
};

/// The older way: one loop that reads, computes and drives, one joint after the other.
struct Monolith : Robot {
  void wait_for(std::size_t frames) {
    while (log.size() < frames) simulation->advance_to_next_event(now() + 1ms);
  }
  void command(int card, AicCommand what) {
    EXPECT_EQ(host.send(command_frame(card, what)), can::SendStatus::kSent);
  }
  void cycle(int number) {
    log.clear();
    const double shares[] = {0.2 * std::sin(0.05 * number), 0.1 + 0.05 * std::sin(0.07 * number)};
    for (int card = 1; card <= 2; ++card) {
      host.send(request_frame(card));
      wait_for(log.size() + 2);
      host.send(motor_frame(card, motor_value(shares[card - 1])));
      wait_for(log.size() + 1);
    }
  }
  base::Duration cycle_time() const { return log.back().end - log.front().begin; }
};

// ---- Times of a cycle

TEST(Cycle, SequentiallyItIsTheTimeOfItsFramesAnd90MicrosecondsForEachCard) {
  Driven robot(AicMode::kSequential);
  for (int i = 1; i <= 100; ++i) {
    robot.cycle(i);
    ASSERT_EQ(robot.driver.reading(), AicReading::kComplete);
    ASSERT_EQ(robot.log.size(), 6u) << "two requests, answers and motor frames";
    ASSERT_EQ(robot.cycle_time(), robot.wire_time() + 2 * 90us);
    robot.advance(base::Time(i * kPeriod + kPeriod) - robot.now() + 1ms);
  }
  RecordProperty("sequential_us", static_cast<int>(robot.cycle_time() / 1us));
}

TEST(Cycle, SynchronouslyItIsTheTimeOfItsFramesAnd90MicrosecondsOnce) {
  Driven robot(AicMode::kSynchronous);
  for (int i = 1; i <= 100; ++i) {
    robot.cycle(i);
    ASSERT_EQ(robot.driver.reading(), AicReading::kComplete);
    ASSERT_EQ(robot.log.size(), 4u) << "SYNC, two answers and a motor frame";
    ASSERT_EQ(robot.cycle_time(), robot.wire_time() + 90us);
    robot.advance(base::Time(i * kPeriod + kPeriod) - robot.now() + 1ms);
  }
  RecordProperty("synchronous_us", static_cast<int>(robot.cycle_time() / 1us));
}

TEST(Cycle, SequentiallyItIsNoLongerThanThatOfAMonolithicLoop) {
  Driven robot(AicMode::kSequential);
  Monolith monolith;
  monolith.advance(1ms);
  for (int card = 1; card <= 2; ++card) {
    monolith.command(card, AicCommand::kActuatorOn);
    monolith.command(card, AicCommand::kBrakeRelease);
  }
  monolith.advance(kPeriod - 1ms);
  base::Duration ours{};
  base::Duration theirs{};
  for (int i = 1; i <= 100; ++i) {
    robot.cycle(i);
    monolith.cycle(i);
    ours += robot.cycle_time();
    theirs += monolith.cycle_time();
    robot.advance(base::Time(i * kPeriod + kPeriod) - robot.now() + 1ms);
    monolith.advance(base::Time(i * kPeriod + kPeriod) - monolith.now() + 1ms);
  }
  EXPECT_LE(ours, theirs * 101 / 100);
  RecordProperty("ours_us", static_cast<int>(ours / 100us));
  RecordProperty("theirs_us", static_cast<int>(theirs / 100us));
}

// ---- The robot as a whole

TEST(Simulation, TheDriversCountIsThatOfTheEncoderAtTheLatch) {
  for (const AicMode mode : {AicMode::kSequential, AicMode::kSynchronous}) {
    Driven robot(mode);
    const can::Frame latch = mode == AicMode::kSequential ? request_frame(1) : sync_frame(0);
    const sim::Encoder encoder(kCountsPerTurn, kMotor.gear_ratio);
    std::optional<std::int64_t> first;
    std::int64_t last = 0;
    robot.simulation->bus().set_tap([&](const can::WireEvent& event) {
      robot.log.push_back(event);
      if (event.frame.id != latch.id) return;
      last = encoder.count(robot.simulation->head().position(kPan, event.end));
      if (!first) first = last;
    });
    for (int i = 1; i <= 200; ++i) {
      robot.cycle(i);
      ASSERT_EQ(robot.driver.card(kPan).counts, last - *first);
      robot.advance(9ms);
    }
    EXPECT_GT(std::abs(last - *first), 1000);
    EXPECT_EQ(robot.driver.card(kPan).counters, AicCounters{});
  }
}

TEST(Simulation, TheWatchdogStopsAMovingJointWhenTheHostGoesSilent) {
  Driven robot(AicMode::kSynchronous);
  robot.driver.set_motor(kTilt, 0.4);
  for (int i = 0; i < 20; ++i) {
    robot.driver.send_motors();
    robot.advance(kPeriod);
  }
  auto& head = robot.simulation->head();
  const base::Time last = robot.log.back().end;
  robot.simulation->advance_to(last + 99ms);
  EXPECT_GT(head.velocity(kTilt, robot.now()), 0.5);
  EXPECT_EQ(robot.simulation->card(kTilt).state(), AicState::kOn);
  robot.simulation->advance_to(last + 100ms);
  EXPECT_EQ(robot.simulation->card(kTilt).state(), AicState::kWatchdog);
  robot.advance(50ms);
  const double stopped = head.position(kTilt, robot.now());
  EXPECT_NEAR(head.velocity(kTilt, robot.now()), 0.0, 1e-6);
  ASSERT_TRUE(robot.driver.card(kTilt).emergency);
  EXPECT_EQ(robot.driver.card(kTilt).emergency->code, AicEmergency::kWatchdog);
  robot.advance(5s);
  EXPECT_NEAR(head.position(kTilt, robot.now()), stopped, 1e-6) << "held against its weight";
}

TEST(Simulation, AFailingSupplyStopsItsJointAndLeavesTheOtherAlone) {
  Driven robot(AicMode::kSynchronous);
  for (int i = 1; i <= 20; ++i) {
    robot.driver.set_motor(kPan, 0.2);
    robot.driver.set_motor(kTilt, 0.3);
    robot.driver.send_motors();
    if (i == 10) robot.simulation->card(kTilt).begin(AicFault::kSupply);
    robot.advance(kPeriod);
  }
  auto& head = robot.simulation->head();
  EXPECT_NEAR(head.velocity(kTilt, robot.now()), 0.0, 1e-6);
  EXPECT_GT(head.velocity(kPan, robot.now()), 0.3);
  EXPECT_EQ(robot.driver.card(kTilt).emergency->code, AicEmergency::kSupply);
}

/// All frames of a run with faults, with their times, and where the joints are at its end.
std::string run_with_faults(base::Duration step) {
  Driven robot(AicMode::kSequential);
  robot.simulation->bus().corrupt_next(3);
  std::string text;
  robot.simulation->bus().set_tap([&](const can::WireEvent& event) {
    text += std::to_string(base::to_ns(event.end)) + " " +
            std::string(can::to_text(event.frame).view()) + "\n";
  });
  for (int i = 1; i <= 100; ++i) {
    robot.driver.begin_reading(robot.now());
    for (base::Duration passed{}; passed < kPeriod; passed += step) robot.advance(step);
    robot.driver.set_motor(kPan, 0.2 * std::sin(0.05 * i));
    robot.driver.set_motor(kTilt, 0.1);
    robot.driver.send_motors();
    if (i == 30) robot.simulation->card(kPan).begin(AicFault::kSilent);
    if (i == 50) robot.simulation->card(kPan).end(AicFault::kSilent);
    if (i == 70) robot.simulation->card(kTilt).begin(AicFault::kOverCurrent);
  }
  auto& head = robot.simulation->head();
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    char position[64];
    std::snprintf(position, sizeof(position), "%a\n", head.position(joint, robot.now()));
    text += position;
  }
  return text;
}

TEST(Simulation, TwoRunsAreEqualToTheBit) {
  const std::string run = run_with_faults(kPeriod);
  EXPECT_GT(run.size(), 10'000u);
  EXPECT_EQ(run, run_with_faults(kPeriod));
}

TEST(Simulation, HowOftenItIsAdvancedChangesNothing) {
  EXPECT_EQ(run_with_faults(kPeriod), run_with_faults(100us));
}

TEST(Simulation, RunsOnAClockThatIsNotItsOwn) {
  // As in real time: the host sends by a clock that is ahead of what was simulated.
  base::Time clock{};
  Robot robot([&clock] { return clock; });
  auto driver =
      AicDriver::make(robot.host, {.cards = {1, 2}, .mode = AicMode::kSynchronous}).value();
  driver.start(clock);
  std::uint64_t complete = 0;
  for (int i = 0; i < 1000; ++i) {
    driver.begin_reading(clock);
    for (const base::Duration wake : {310us, 170us, 520us, 9000us}) {
      clock += wake;
      robot.simulation->advance_to(clock);
      driver.poll(clock);
    }
    if (driver.reading() == AicReading::kComplete) ++complete;
  }
  EXPECT_EQ(complete, 1000u);
  EXPECT_EQ(driver.card(0).counters, AicCounters{});
}

TEST(Simulation, AllocatesNothingWhileItRuns) {
  Driven robot(AicMode::kSynchronous);
  robot.keeps_log = false;
  testing::RealtimeGuard guard;
  const auto violations = guard.watch([&] {
    for (int i = 0; i < 50; ++i) {
      robot.driver.begin_reading(robot.now());
      robot.advance(kPeriod);
      robot.driver.set_motor(kPan, 0.1);
      robot.driver.send_motors();
      if (i == 25) robot.simulation->card(kPan).begin(AicFault::kEncoderError);
    }
    robot.advance(200ms);
  });
  EXPECT_EQ(violations, 0u) << guard.report();
  EXPECT_EQ(robot.driver.card(kTilt).emergency->code, AicEmergency::kWatchdog);
}

}  // namespace
}  // namespace armature::janus
