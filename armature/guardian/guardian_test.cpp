// SPDX-License-Identifier: Apache-2.0
#include "armature/guardian/guardian.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/can/bus_server.hpp"
#include "armature/can/virtual_bus.hpp"
#include "armature/platform/clock.hpp"

namespace armature::guardian {
namespace {

using can::data_frame;
using can::Frame;
using platform::monotonic_now;

constexpr base::Duration kPeriod = std::chrono::milliseconds(2);
const Frame kOff = data_frame(0x101, {0x80});
const Frame kAlsoOff = data_frame(0x102, {0x80});
const Frame kQuestion = data_frame(0x103, {0x01});

bool comes_true(const std::function<bool()>& condition) {
  const base::Time end = monotonic_now() + std::chrono::seconds(20);
  while (!condition()) {
    if (monotonic_now() > end) return false;
    platform::sleep_until(monotonic_now() + std::chrono::milliseconds(1));
  }
  return true;
}

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "armature-XXXXXX").string();
    EXPECT_NE(mkdtemp(pattern.data()), nullptr);
    path_ = pattern;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string bus() const { return path_ + "/bus"; }

 private:
  std::string path_;
};

/// A bus in real time with a drive, which says whether it is idle when it is asked.
class ServedDrive {
 public:
  explicit ServedDrive(const std::string& path) : drive_(bus_.add_station("drive")) {
    base::Diagnostics diagnostics;
    can::BusOptions options;
    options.on_news = [this] { answer(); };
    EXPECT_TRUE(drive_.open(options, diagnostics)) << diagnostics.to_text();
    server_ = can::BusServer::open(bus_, path, diagnostics);
    EXPECT_NE(server_, nullptr) << diagnostics.to_text();
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  std::vector<Frame> heard() {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  std::size_t clients() {
    const std::lock_guard lock(mutex_);
    return server_->clients();
  }

 private:
  void answer() {
    can::Arrival arrival;
    while (drive_.receive(arrival) == can::ReceiveStatus::kReceived) {
      heard_.push_back(arrival.frame);
      if (arrival.frame == kOff) idle_ = true;
      if (arrival.frame == kQuestion) {
        static_cast<void>(
            drive_.send(data_frame(0x201, {static_cast<std::uint8_t>(idle_ ? 0 : 1), 0x55})));
      }
    }
  }
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      base::Time next = monotonic_now() + std::chrono::milliseconds(5);
      {
        const std::lock_guard lock(mutex_);
        server_->take();
        bus_.advance_to(monotonic_now());
        server_->give();
        next = std::min(next, bus_.next_event().value_or(next));
      }
      server_->wait_until(next);
      std::this_thread::yield();
    }
  }

  can::VirtualBus bus_{"served", 1'000'000, monotonic_now};
  can::VirtualStation& drive_;
  std::unique_ptr<can::BusServer> server_;
  std::mutex mutex_;
  std::vector<Frame> heard_;
  bool idle_ = false;
  std::jthread thread_;
};

Orders orders_for(const std::string& path) {
  Orders orders;
  orders.bus = "virtual:" + path;
  orders.bit_rate = 1'000'000;
  orders.period = kPeriod;
  orders.safe = {kOff, kAlsoOff};
  orders.questions = {kQuestion};
  orders.answers = {{.device = 0, .frame = data_frame(0x201, {0}), .mask = {0xff}}};
  orders.answers_filter = {.id = 0x201};
  return orders;
}

/// The first cycle; the next never comes.
void run_a_cycle(Guardian& guardian) {
  EXPECT_EQ(guardian.beat(monotonic_now()), Guardian::Finding::kGood);
}

TEST(Guardian, EndsWithItsProcessAndHasSentNothing) {
  const Folder folder;
  ServedDrive drive(folder.bus());
  auto guardian = Guardian::start(orders_for(folder.bus()));
  ASSERT_TRUE(guardian) << guardian.error();
  EXPECT_NE(guardian.value()->describe().find("virtual:" + folder.bus()), std::string::npos);
  EXPECT_TRUE(comes_true([&] { return drive.clients() == 1; }));
  const int process = guardian.value()->process();
  guardian.value().reset();
  EXPECT_TRUE(comes_true([&] { return ::kill(process, 0) != 0; }));
  EXPECT_TRUE(drive.heard().empty());
}

TEST(Guardian, WithoutCyclesItSwitchesOffAndTheProcessLearnsOfIt) {
  const Folder folder;
  ServedDrive drive(folder.bus());
  auto started = Guardian::start(orders_for(folder.bus()));
  ASSERT_TRUE(started) << started.error();
  Guardian& guardian = *started.value();
  run_a_cycle(guardian);
  EXPECT_TRUE(comes_true([&] { return std::ranges::count(drive.heard(), kOff) > 1; }));
  EXPECT_EQ(guardian.beat(monotonic_now()), Guardian::Finding::kActed);
  EXPECT_EQ(guardian.beat(monotonic_now()), Guardian::Finding::kActed);
  EXPECT_GE(guardian.silence(), 3 * kPeriod);
  // The operator starts it again.
  guardian.rest();
  run_a_cycle(guardian);
}

TEST(Guardian, AtRestItExpectsNoCycles) {
  const Folder folder;
  ServedDrive drive(folder.bus());
  auto started = Guardian::start(orders_for(folder.bus()));
  ASSERT_TRUE(started) << started.error();
  Guardian& guardian = *started.value();
  guardian.rest();
  platform::sleep_until(monotonic_now() + 20 * kPeriod);
  EXPECT_TRUE(drive.heard().empty());
}

TEST(Guardian, OfAKilledProcessSendsWhatItWasGivenUntilTheDriveIsIdleAndThenEnds) {
  const Folder folder;
  const pid_t process = ::fork();
  ASSERT_GE(process, 0);
  if (process == 0) {
    while (!std::filesystem::exists(folder.bus())) ::usleep(1000);
    auto guardian = Guardian::start(orders_for(folder.bus()));
    if (!guardian) ::_exit(1);
    for (;;) {
      static_cast<void>(guardian.value()->beat(monotonic_now()));
      ::usleep(1000);
    }
  }
  ServedDrive drive(folder.bus());
  EXPECT_TRUE(comes_true([&] { return drive.clients() == 1; }));
  ::kill(process, SIGKILL);
  EXPECT_EQ(::waitpid(process, nullptr, 0), process);
  EXPECT_TRUE(comes_true([&] { return drive.clients() == 0; }));
  const std::vector<Frame> heard = drive.heard();
  for (const Frame& needed : {kOff, kAlsoOff, kQuestion}) {
    EXPECT_GT(std::ranges::count(heard, needed), 0);
  }
  for (const Frame& each : heard) {
    EXPECT_TRUE(each == kOff || each == kAlsoOff || each == kQuestion) << to_text(each).view();
  }
}

TEST(Guardian, ThatIsKilledOrStoppedIsFound) {
  for (const int signal : {SIGKILL, SIGSTOP}) {
    const Folder folder;
    ServedDrive drive(folder.bus());
    auto started = Guardian::start(orders_for(folder.bus()));
    ASSERT_TRUE(started) << started.error();
    Guardian& guardian = *started.value();
    ::kill(guardian.process(), signal);
    EXPECT_TRUE(
        comes_true([&] { return guardian.beat(monotonic_now()) == Guardian::Finding::kGone; }));
    ::kill(guardian.process(), SIGKILL);
  }
}

TEST(Guardian, ASignalToAllProcessesOfATerminalIsNotForIt) {
  const Folder folder;
  ServedDrive drive(folder.bus());
  auto started = Guardian::start(orders_for(folder.bus()));
  ASSERT_TRUE(started) << started.error();
  const int process = started.value()->process();
  EXPECT_NE(::getpgid(process), ::getpgid(0));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::kill(process, signal);
  run_a_cycle(*started.value());
  EXPECT_TRUE(comes_true([&] { return !drive.heard().empty(); }));
}

TEST(Guardian, WithoutItsBusItDoesNotBegin) {
  const Folder folder;
  const auto guardian = Guardian::start(orders_for(folder.bus()));
  ASSERT_FALSE(guardian);
  EXPECT_EQ(guardian.error().find("it cannot reach the bus 'virtual:" + folder.bus()), 0u)
      << guardian.error();
}

std::string refusal_of(const std::function<void(Orders&)>& change) {
  Orders orders = orders_for("/tmp/some.bus");
  change(orders);
  return problem_of(orders);
}

TEST(GuardiansOrders, AreRefusedIfTheyAreNoneThatItCanFollow) {
  EXPECT_EQ(problem_of(orders_for("/tmp/some.bus")), "");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.safe.clear(); }),
            "no frame to switch the drives off is given");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.period = {}; }), "the period is not above 0");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.safe.resize(65, kOff); }),
            "65 frames that switch off, expected at most 64");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.safe[0].extended = true; }),
            "a frame must have an identifier of 11 bits and data");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.questions[0].size = 9; }),
            "a frame must have an identifier of 11 bits and data");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.answers[0].frame.id = 0x202; }),
            "an answer does not pass the filter");
  EXPECT_EQ(refusal_of([](Orders& orders) { orders.bus = "virtual:" + std::string(200, 'x'); }),
            "the bus's name is too long");
}

}  // namespace
}  // namespace armature::guardian
