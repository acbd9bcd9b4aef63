// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "armature/can/make_bus.hpp"
#include "armature/control/transmission.hpp"
#include "armature/platform/clock.hpp"
#include "armature/rt/wakeup.hpp"
#include "robots/wam/driver/wam_driver.hpp"
#include "robots/wam/driver/wam_startup.hpp"
#include "robots/wam/emulator/emulator_input.hpp"
#include "robots/wam/emulator/running_emulator.hpp"
#include "robots/wam/wam_urdf.hpp"

// The emulated arm in a process of its own and its host's driver, on the interfaces of
// scripts/test-socketcan. Time there is counted in instructions, so it is the same for all runs:
// this tests 500 Hz and the driver's own timeouts, whatever else the machine does.

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration kPeriod = 2ms;
constexpr int kCycles = 500;

struct Case {
  std::size_t joints;
  const char* emulator;
  const char* host;
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.joints << " joints, from " << tested.emulator << " to " << tested.host;
}

const ArmNumbers& numbers_of(const Case& tested) { return tested.joints == 4 ? wam4() : wam7(); }

/// A process that is killed at the end.
class EmulatorProcess {
 public:
  explicit EmulatorProcess(const Case& tested) {
    if (::pipe(pipe_.data()) != 0) return;
    process_ = ::fork();
    if (process_ == 0) run(tested);
    ::close(pipe_[0]);
  }
  EmulatorProcess(const EmulatorProcess&) = delete;
  EmulatorProcess& operator=(const EmulatorProcess&) = delete;
  ~EmulatorProcess() {
    send(SIGKILL);
    ::waitpid(process_, nullptr, 0);
    ::close(pipe_[1]);
  }
  void send(int signal) const { ::kill(process_, signal); }
  void say(std::string command) const {
    command += '\n';
    EXPECT_EQ(::write(pipe_[1], command.data(), command.size()),
              static_cast<ssize_t>(command.size()));
  }

 private:
  [[noreturn]] void run(const Case& tested) const {
    RunningEmulator::Config config;
    config.emulator = Emulator::standard(tested.joints);
    config.arm.coulomb_friction = friction(tested);
    config.urdf = tested.joints == 4 ? kWam4Urdf : kWam7Urdf;
    config.interface = tested.emulator;
    auto emulator = RunningEmulator::start(config);
    if (!emulator) std::fputs(emulator.error().c_str(), stderr);
    EmulatorInput input(EmulatorInput::Kind::kLines);
    std::array<char, 256> said{};
    while (emulator) {
      const ssize_t size = ::read(pipe_[0], said.data(), said.size());
      if (size <= 0) break;
      for (const auto& line : input.take({said.data(), static_cast<std::size_t>(size)})) {
        if (!emulator.value()->give(parse_emulator_command(line, tested.joints).value()))
          ::_exit(2);
      }
    }
    ::_exit(1);
  }

  /// Joint 1 turns freely; the others stay, or they would fall, since nobody controls them.
  static std::vector<double> friction(const Case& tested) {
    std::vector<double> torques(tested.joints, 50.0);
    torques[0] = 0.0;
    return torques;
  }

  std::array<int, 2> pipe_{};
  pid_t process_ = -1;
};

class EmulatorOnCan : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    can::BusOptions options = WamDriver::bus_options();
    options.on_news = [this] { news.notify(); };
    base::Diagnostics diagnostics;
    ASSERT_TRUE(bus->open(options, diagnostics)) << diagnostics.to_text();
    WamStartup::Config config;
    config.motors = GetParam().joints;
    config.home = motors_at_home();
    startup = WamStartup::make(*bus, config).value();
  }
  static std::array<double, kMostMotors> motors_at_home() {
    const ArmNumbers& numbers = numbers_of(GetParam());
    std::vector<double> angles(numbers.joints());
    control::Transmission::make(numbers.transmission).value().motor_angles(numbers.home, angles);
    std::array<double, kMostMotors> home{};
    std::copy(angles.begin(), angles.end(), home.begin());
    return home;
  }
  static base::Time now() { return platform::monotonic_now(); }

  /// Talks until nothing is left to say; the operator acts when he is waited for.
  WamProgress talk() {
    const base::Time end = now() + 10s;
    bool acted = false;
    while (now() < end) {
      const WamProgress progress = startup->poll(now());
      if (progress > WamProgress::kWaitingForIdle) return progress;
      if (progress == WamProgress::kWaitingForIdle && !std::exchange(acted, true)) {
        emulator.say("release");
        emulator.say("idle");
      }
      news.wait_until(std::min(startup->deadline(), end));
    }
    return WamProgress::kTalking;
  }
  bool start() {
    startup->connect(now());
    if (talk() != WamProgress::kDone) return false;
    startup->zero(now());
    if (talk() != WamProgress::kDone) return false;
    driver.emplace(WamDriver::make(*bus, startup->record(), {}).value());
    driver->start(now());
    next = now();
    return true;
  }
  bool read() {
    driver->begin_reading(now());
    while (driver->poll(now()) == WamReading::kWaiting) news.wait_until(driver->deadline());
    return driver->reading() == WamReading::kComplete;
  }
  bool cycle(double torque = 0.0) {
    next += kPeriod;
    platform::sleep_until(next);
    const bool complete = read();
    driver->set_torque(0, torque, now());
    return driver->send_torques(now()) == can::SendStatus::kSent && complete;
  }
  template <typename Condition>
  bool comes_true_in_the_cycle(const Condition& condition, double torque = 0.0) {
    const base::Time end = now() + 2s;
    while (!condition()) {
      if (now() > end) return false;
      cycle(torque);
    }
    return true;
  }

  EmulatorProcess emulator{GetParam()};
  rt::Wakeup news;
  std::unique_ptr<can::Bus> bus = can::make_bus(GetParam().host, kBitRate);
  std::unique_ptr<WamStartup> startup;
  std::optional<WamDriver> driver;
  base::Time next{};
};

TEST_P(EmulatorOnCan, AHostOnTheOtherEndStartsItUpRunsItsCycleAndTurnsAJoint) {
  ASSERT_TRUE(start()) << startup->diagnostics().to_text();
  EXPECT_EQ(startup->record().motors, GetParam().joints);
  const auto home = motors_at_home();

  int complete = 0;
  const base::Time begin = next;
  for (int i = 0; i < kCycles; ++i) complete += cycle() ? 1 : 0;
  EXPECT_EQ(complete, kCycles);
  EXPECT_LT(now(), begin + (kCycles + 1) * kPeriod);
  EXPECT_EQ(bus->counters().lost, 0u);
  EXPECT_EQ(driver->fault(), WamFault::kNone) << to_text(driver->fault());
  EXPECT_NEAR(driver->motor(0).position, home[0], 0.1);

  emulator.say("activate");
  ASSERT_TRUE(comes_true_in_the_cycle([this] { return driver->active(); }));
  const double before = driver->motor(0).position;
  EXPECT_TRUE(
      comes_true_in_the_cycle([&] { return driver->motor(0).position > before + 0.5; }, 0.005))
      << to_text(driver->fault());
}

/// An ordinary process that takes all that it gets of the machine, until the end.
class BusyProcess {
 public:
  BusyProcess() : process_(::fork()) {
    while (process_ == 0) continue;
  }
  BusyProcess(const BusyProcess&) = delete;
  BusyProcess& operator=(const BusyProcess&) = delete;
  ~BusyProcess() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

 private:
  const pid_t process_;
};

class EmulatorOnBusyMachine : public EmulatorOnCan {
 protected:
  /// As the thread of a deployment.
  static void be_urgent() {
    const sched_param urgent{80};
    EXPECT_EQ(::sched_setscheduler(0, SCHED_FIFO, &urgent), 0);
  }
  static void be_ordinary() {
    const sched_param ordinary{0};
    EXPECT_EQ(::sched_setscheduler(0, SCHED_OTHER, &ordinary), 0);
  }
};

TEST_P(EmulatorOnBusyMachine, EachCycleHasItsAnswersInTimeFromTheFirstOn) {
  ASSERT_TRUE(start()) << startup->diagnostics().to_text();
  std::vector<std::unique_ptr<BusyProcess>> others;
  for (int i = 0; i < 4; ++i) others.push_back(std::make_unique<BusyProcess>());
  be_urgent();
  base::Duration longest{};
  int complete = 0;
  next = now();
  for (int i = 0; i < kCycles; ++i) {
    next += kPeriod;
    platform::sleep_until(next);
    complete += read() ? 1 : 0;
    longest = std::max(longest, now() - next);
    driver->send_torques(now());
  }
  be_ordinary();
  EXPECT_EQ(complete, kCycles);
  EXPECT_LT(longest, WamDriver::Config{}.reply_timeout);
}

class BrokenEmulatorOnCan : public EmulatorOnCan {};

TEST_P(BrokenEmulatorOnCan, ASilentBoardIsNamedAndNothingStandsStill) {
  emulator.say("fault board silent");
  startup->connect(now());
  EXPECT_EQ(talk(), WamProgress::kFailed) << "in E-stop there is nobody else";
  emulator.say("fault board heals");
  EXPECT_TRUE(start()) << startup->diagnostics().to_text();
}

TEST_P(BrokenEmulatorOnCan, APuckThatFallsSilentIsNamed) {
  ASSERT_TRUE(start()) << startup->diagnostics().to_text();
  ASSERT_TRUE(comes_true_in_the_cycle([this] { return driver->motor(2).known; }));
  emulator.say("fault puck 3 silent");
  EXPECT_TRUE(comes_true_in_the_cycle([this] { return driver->fault() == WamFault::kPuckSilent; }));
  EXPECT_EQ(driver->fault_node(), 3);
}

std::string name_of(const ::testing::TestParamInfo<Case>& tested) {
  return "Of" + std::to_string(tested.param.joints) + "JointsOn" + tested.param.host;
}

INSTANTIATE_TEST_SUITE_P(Kernel, EmulatorOnCan,
                         ::testing::Values(Case{4, "vcan0", "vcan0"}, Case{7, "vcan0", "vcan0"},
                                           Case{4, "can0", "can1"}, Case{7, "can0", "can1"}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Kernel, EmulatorOnBusyMachine,
                         ::testing::Values(Case{7, "vcan0", "vcan0"}, Case{7, "can0", "can1"}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Kernel, BrokenEmulatorOnCan, ::testing::Values(Case{7, "can0", "can1"}),
                         name_of);

}  // namespace
}  // namespace armature::wam
