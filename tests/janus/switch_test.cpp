// SPDX-License-Identifier: Apache-2.0
// Going over from one controller to the other while the head moves: nothing jumps, nothing is lost,
// and who cannot start leaves the others as they are.
#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "armature/component/interface.hpp"
#include "armature/exec/modes.hpp"
#include "armature/lua/script.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using component::State;
using ::testing::HasSubstr;

constexpr const char* kPid = "pid";
constexpr const char* kFeedForward = "feed_forward";
constexpr double kLargestError = 0.01;  ///< [rad] as of the experiment

/// The head in both modes, and what its motors are told in each cycle.
class Head {
 public:
  explicit Head(std::vector<std::string> overrides = {}) : robot("modes.yaml", overrides) {
    robot.start_armed();
  }

  std::string mode() { return std::string(robot.value<exec::ModeName>("Modes", "mode").view()); }
  std::string other_mode() { return mode() == kPid ? kFeedForward : kPid; }
  /// As a peer or a script would: it is accepted now and done between two cycles.
  std::string send(const std::string& to) {
    return robot.call("Modes", "switch", {types::Value::of(exec::ModeName(to))});
  }
  std::string switch_to(const std::string& to) {
    return std::string(robot.application().switch_mode(to).reason());
  }
  Vector act() { return robot.value<Vector>("Actuator", "act"); }
  double error(std::size_t joint) {
    const std::string pid = (mode() == kPid ? "PID" : "PIDFF") + std::to_string(joint + 1);
    return robot.value<double>(pid.c_str(), "Ref") - robot.value<double>(pid.c_str(), "Sen");
  }
  SimulatedJanus& janus() {
    return *static_cast<SimulatedJanus*>(robot.application().find("Cards"));
  }
  Vector positions() { return {janus().position(0), janus().position(1)}; }
  int lost_cycles() {
    return robot.value<int>("Actuator", "samples_without_act") +
           robot.value<int>("Sensor", "incomplete_rounds") +
           robot.value<int>("Cards", "lost_answers");
  }
  int clipped() {
    return robot.value<int>("Joint1", "clipped") + robot.value<int>("Joint2", "clipped");
  }
  void expect_in_service() {
    EXPECT_EQ(robot.application().faults(), 0u);
    EXPECT_EQ(robot.application().reactions(), 0u);
    EXPECT_TRUE(robot.value<bool>("Arming", "armed"));
  }

  Robot robot;
};

/// What the motors were told in a run of the experiment, and how well it went.
struct Course {
  std::vector<Vector> acts;           ///< in each cycle [V]
  std::vector<std::size_t> switches;  ///< the cycles before which modes were switched
  double largest_error = 0.0;         ///< [rad], from the first motion on
  int lost = 0;
  int clipped = 0;  ///< in the motions; an armed joint is limited for a while
};

constexpr std::size_t kFirstMotion = 500;  ///< cycle

/// 60 s with the motions of table 2. `between` is called before each cycle with its number, and
/// says whether it switched.
template <typename Between>
Course run(Head& head, Between& between) {
  Course course;
  const base::Time begin = head.robot.application().now();
  const int lost_before = head.lost_cycles();
  int clipped_before = 0;
  std::size_t next = 0;
  for (std::size_t cycle = 0; cycle < 6000; ++cycle) {
    const base::Time now = begin + cycle * 10ms;
    if (next < kTable2.size() && now >= begin + kTable2[next].at) {
      EXPECT_EQ(head.robot.move_to(kTable2[next].positions, kTable2[next].time), "");
      ++next;
    }
    if (cycle == kFirstMotion) clipped_before = head.clipped();
    if (between(cycle)) course.switches.push_back(cycle);
    head.robot.run_for(now + 10ms - head.robot.application().now());
    course.acts.push_back(head.act());
    for (std::size_t joint = 0; cycle > kFirstMotion && joint < kJoints; ++joint) {
      course.largest_error = std::max(course.largest_error, std::abs(head.error(joint)));
    }
  }
  course.lost = head.lost_cycles() - lost_before;
  course.clipped = head.clipped() - clipped_before;
  head.expect_in_service();
  return course;
}

Course run_in(const std::string& mode, const std::vector<std::string>& overrides = {}) {
  Head head(overrides);
  EXPECT_EQ(head.switch_to(mode), "");
  const auto never = [](std::size_t) { return false; };
  return run(head, never);
}

double step(const Course& course, std::size_t cycle, std::size_t joint) {
  return std::abs(course.acts[cycle][joint] - course.acts[cycle - 1][joint]);
}

/// The largest change of the command from one cycle to the next in the motions [V].
double largest_step(const Course& course, std::size_t joint) {
  double largest = 0.0;
  for (std::size_t cycle = kFirstMotion + 1; cycle < course.acts.size(); ++cycle) {
    largest = std::max(largest, step(course, cycle, joint));
  }
  return largest;
}

/// Switches back and forth in the motions, 0.2 to 2 s apart, at any time within a cycle, by turns
/// as a tool and as a script do it.
class BackAndForth {
 public:
  BackAndForth(Head& head, unsigned seed) : head_(head), random_(seed) {}

  bool operator()(std::size_t cycle) {
    if (cycle < next_) return false;
    head_.robot.run_for(std::chrono::microseconds(random_() % 10000));
    const std::string to = head_.other_mode();
    EXPECT_EQ(random_() % 2 == 0 ? head_.send(to) : head_.switch_to(to), "");
    next_ = cycle + 20 + random_() % 180;
    return true;
  }

 private:
  Head& head_;
  std::mt19937 random_;
  std::size_t next_ = kFirstMotion + 20;
};

class Switch : public ::testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> with(std::vector<std::string> more = {}) const {
    more.push_back(std::string("mode=") + GetParam());
    return more;
  }
};
INSTANTIATE_TEST_SUITE_P(Bus, Switch, ::testing::Values("synchronous", "sequential"),
                         [](const auto& mode) { return std::string(mode.param); });

TEST_P(Switch, AtAnyTimeOfTheExperimentMakesNoStepAndLosesNoCycle) {
  const Course without[] = {run_in(kPid, with()), run_in(kFeedForward, with())};
  for (const unsigned seed : {1u, 2u}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Head head(with());
    BackAndForth back_and_forth(head, seed);
    const Course course = run(head, back_and_forth);
    EXPECT_GT(course.switches.size(), 40u);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      for (const std::size_t cycle : course.switches) {
        // The switch came before the cycle of the Sampler or after it.
        const double first = std::min(step(course, cycle, joint), step(course, cycle + 1, joint));
        ASSERT_EQ(first, 0.0) << "cycle " << cycle << ", joint " << joint + 1;
      }
      const double plain =
          std::max(largest_step(without[0], joint), largest_step(without[1], joint));
      std::printf("joint %zu: largest step %.3f V, without a switch %.3f V\n", joint + 1,
                  largest_step(course, joint), plain);
      EXPECT_LE(largest_step(course, joint), 1.05 * plain);
    }
    std::printf("%zu switches, largest error %.5f rad, without %.5f and %.5f rad\n",
                course.switches.size(), course.largest_error, without[0].largest_error,
                without[1].largest_error);
    EXPECT_LE(course.largest_error, kLargestError);
    EXPECT_EQ(course.lost, 0);
    EXPECT_EQ(course.clipped, 0);
  }
}

TEST(SwitchAsAStep, WithoutAHandOverTheCommandJumps) {
  const Course without = run_in(kFeedForward);
  Head head({"Controller.SwitchTime=0", "ControllerFF.SwitchTime=0"});
  BackAndForth back_and_forth(head, 1);
  const Course course = run(head, back_and_forth);
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    EXPECT_GE(largest_step(course, joint), 5.0 * largest_step(without, joint));
  }
}

TEST(SwitchTwice, IsTheSameToTheBit) {
  Head first;
  BackAndForth as_first(first, 7);
  Head second;
  BackAndForth as_second(second, 7);
  EXPECT_EQ(run(first, as_first).acts, run(second, as_second).acts);
}

class Switching : public ::testing::Test {
 protected:
  void move() {
    ASSERT_EQ(head.robot.move_to({4.0, 4.0}, 5.0), "");
    head.robot.run_for(2s);
  }
  State state(const char* component) { return head.robot.state(component); }
  /// As no tool can: what they set is judged before.
  void spoil(const char* component, std::string_view name, double value) {
    for (auto* property :
         component::interface_of(*head.robot.application().find(component)).properties) {
      if (property->name() != name) continue;
      types::Value unchecked = types::Value::of(value);
      property->swap(unchecked);
    }
  }
  /// All that was stopped with the controller.
  void put_back_into_service() {
    exec::Application& application = head.robot.application();
    for (int round = 0; round < 3; ++round) {
      for (const auto& entry : application.blueprint().components) {
        const std::string& name = entry.component->name();
        static_cast<void>(application.reset_component(name));
        static_cast<void>(application.start_component(name));
      }
      head.robot.run_for(20ms);
    }
  }

  Head head;
};

TEST_F(Switching, RunsTheComponentsOfOneModeOnly) {
  EXPECT_EQ(head.mode(), kPid);
  EXPECT_EQ(state("Controller"), State::kRunning);
  EXPECT_EQ(state("ControllerFF"), State::kStopped);
  ASSERT_EQ(head.send(kFeedForward), "");
  head.robot.run_for(10ms);
  EXPECT_EQ(head.mode(), kFeedForward);
  for (const char* in : {"ControllerFF", "Model", "PIDFF1", "PIDFF2"}) {
    EXPECT_EQ(state(in), State::kRunning) << in;
  }
  for (const char* out : {"Controller", "PID1", "PID2"}) EXPECT_EQ(state(out), State::kStopped);
}

TEST_F(Switching, ARefusedStartLeavesThePresentControllerInMotionToTheBit) {
  Head undisturbed;
  ASSERT_EQ(undisturbed.robot.move_to({4.0, 4.0}, 5.0), "");
  undisturbed.robot.run_for(2s);
  move();
  spoil("PIDFF2", "UMin", 12.0);
  EXPECT_THAT(head.switch_to(kFeedForward),
              HasSubstr("'PIDFF2' refuses to start: Pid: u_max is 12, expected a number above"));
  EXPECT_EQ(head.mode(), kPid);
  EXPECT_EQ(state("ControllerFF"), State::kStopped) << "it had started before";
  for (int cycle = 0; cycle < 400; ++cycle) {
    head.robot.run_for(10ms);
    undisturbed.robot.run_for(10ms);
    ASSERT_EQ(head.act(), undisturbed.act());
  }
  head.expect_in_service();
  EXPECT_EQ(head.positions(), undisturbed.positions());
}

TEST_F(Switching, IsRefusedToAModeWithAFaultedControllerUntilThatIsReset) {
  move();
  head.robot.application().find("ControllerFF")->fault("broken");
  EXPECT_EQ(head.switch_to(kFeedForward), "'ControllerFF' is in Exception: broken");
  EXPECT_THAT(head.send(kFeedForward), HasSubstr("'ControllerFF' is in Exception: broken"));
  EXPECT_EQ(head.mode(), kPid);
  head.robot.run_for(1s);
  EXPECT_EQ(head.robot.application().reactions(), 0u) << "nobody depended on it";
  ASSERT_TRUE(head.robot.application().reset_component("ControllerFF"));
  EXPECT_EQ(head.switch_to(kFeedForward), "");
  head.robot.run_for(4s);
  EXPECT_NEAR(head.positions()[0], 4.0, 1e-3);
}

TEST_F(Switching, AwayFromAFaultedControllerArmsAndMovesNothing) {
  move();
  head.robot.application().find("Controller")->fault("broken");
  head.robot.run_for(3s);
  ASSERT_FALSE(head.robot.value<bool>("Arming", "armed"));
  const Vector rest = head.positions();
  ASSERT_EQ(head.switch_to(kFeedForward), "");
  head.robot.run_for(1s);
  put_back_into_service();
  EXPECT_EQ(state("Controller"), State::kStopped);
  EXPECT_EQ(state("ControllerFF"), State::kRunning);
  EXPECT_FALSE(head.robot.value<bool>("Arming", "armed"));
  EXPECT_NEAR(head.positions()[0], rest[0], 1e-4);
  EXPECT_NEAR(head.positions()[1], rest[1], 2e-3);
  head.robot.arm();
  ASSERT_EQ(head.robot.move_to({1.0, 1.0}, 3.0), "");
  head.robot.run_for(5s);
  EXPECT_NEAR(head.positions()[0], 1.0, 2e-3);
  EXPECT_NEAR(head.positions()[1], 1.0, 2e-3);
}

TEST_F(Switching, WhileTheControllerBrakesForWantOfAReferenceItGoesOnBraking) {
  for (const base::Duration braked : {150ms, 2000ms}) {
    ASSERT_EQ(head.robot.move_to({0.5, 0.5}, 4.0), "");
    head.robot.run_for(5s);
    ASSERT_EQ(head.robot.move_to({4.0, 4.0}, 5.0), "");
    head.robot.run_for(2s);
    ASSERT_TRUE(head.robot.application().stop_component("Generator"));
    head.robot.run_for(braked);
    const double speed = head.robot.value<double>("Joint1", "Displacement") / 0.01;
    const Vector before = head.positions();
    ASSERT_EQ(head.switch_to(head.other_mode()), "");
    head.robot.run_for(2s);
    EXPECT_LE(std::abs(head.positions()[0] - before[0]), speed * speed / 10.0 + 0.02);
    EXPECT_TRUE(head.robot.value<bool>("Arming", "armed"));
    const Vector rest = head.positions();
    ASSERT_TRUE(head.robot.application().start_component("Generator"));
    head.robot.run_for(1s);
    EXPECT_NEAR(head.positions()[0], rest[0], 2e-3) << "the old motion is not gone on with";
    EXPECT_NEAR(head.positions()[1], rest[1], 2e-3);
  }
  ASSERT_EQ(head.robot.move_to({1.0, 1.0}, 3.0), "");
  head.robot.run_for(4s);
  EXPECT_NEAR(head.positions()[0], 1.0, 1e-3);
}

TEST_F(Switching, ToAModeThatThereIsNotSaysWhichThereAre) {
  EXPECT_EQ(head.switch_to("feedforward"),
            "unknown mode 'feedforward' (did you mean 'feed_forward'?)");
  EXPECT_THAT(head.send("feedforward"),
              HasSubstr("unknown mode 'feedforward', known: pid, feed_forward"));
}

TEST_F(Switching, AComponentOfAnotherModeIsNotStartedByItself) {
  const auto outcome = head.robot.application().start_component("ControllerFF");
  EXPECT_EQ(
      outcome.reason(),
      "'ControllerFF' does not belong to the present mode 'pid': switch to a mode that has it");
  EXPECT_EQ(state("ControllerFF"), State::kStopped);
}

TEST_F(Switching, BreaksNoRuleOfRealTime) {
  move();
  for (const char* to : {kFeedForward, kPid, kFeedForward}) {
    ASSERT_EQ(head.send(to), "");
    const testing::RealtimeGuard guard;
    head.robot.run_for(300ms);
    EXPECT_EQ(guard.violations(), 0u) << guard.report();
    EXPECT_EQ(head.mode(), to);
  }
}

TEST_F(Switching, AScriptDoesItWithoutAGrant) {
  lua::Options options;
  std::vector<std::string> lines;
  options.print = [&lines](std::string_view line) { lines.emplace_back(line); };
  base::Diagnostics diagnostics;
  const auto script = lua::parse_script(
      "assert(wait(Modes:switch('feed_forward')))\nprint(Modes.mode)\n"
      "local done, why = wait(Modes:switch('fed'))\n",
      "switch.lua", options, diagnostics);
  script->run(head.robot.application(), 1s, nullptr, diagnostics);
  EXPECT_EQ(lines, std::vector<std::string>{"feed_forward"});
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("unknown mode 'fed'"));
  EXPECT_EQ(head.mode(), kFeedForward);
}

/// Whatever the operator does at the same time: nothing arms, and nothing moves that is disarmed.
TEST(SwitchWhile, StoppingDisarmingAndArmingArmsAndMovesNothing) {
  std::mt19937 random(20261122);
  const auto some = [&](unsigned most) {
    return std::chrono::microseconds(random() % (1000 * most));
  };
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    Head head;
    ASSERT_EQ(head.robot.move_to({3.0, 3.0}, 5.0), "");
    head.robot.run_for(500ms + some(3000));
    ASSERT_EQ(head.robot.call("Arming", "stop"), "");
    head.robot.run_for(some(300));
    ASSERT_EQ(head.send(head.other_mode()), "");
    head.robot.run_for(2s);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      EXPECT_LE(std::abs(head.error(joint)), 1e-3) << "it stands where it came to rest";
    }
    head.expect_in_service();
    ASSERT_EQ(head.robot.move_to({1.0, 1.0}, 3.0), "");
    head.robot.run_for(some(2000));
    ASSERT_EQ(head.robot.call("Arming", "disarm"), "");
    head.robot.run_for(some(30));
    ASSERT_EQ(head.switch_to(head.other_mode()), "");
    head.robot.run_for(3s);
    const Vector rest = head.positions();
    for (int k = 0; k < 3; ++k) {
      ASSERT_EQ(head.send(head.other_mode()), "");
      head.robot.run_for(some(300));
      EXPECT_FALSE(head.robot.value<bool>("Arming", "armed"));
    }
    ASSERT_EQ(head.robot.call("Arming", "arm"), "");
    head.robot.run_for(some(60));
    ASSERT_EQ(head.send(head.other_mode()), "");
    head.robot.run_for(2s);
    ASSERT_TRUE(head.robot.value<bool>("Arming", "armed"));
    EXPECT_NEAR(head.positions()[0], rest[0], 5e-3) << "arming moves nothing";
    EXPECT_NEAR(head.positions()[1], rest[1], 5e-3);
    ASSERT_EQ(head.robot.move_to({1.0, 1.0}, 3.0), "");
    head.robot.run_for(5s);
    EXPECT_NEAR(head.positions()[0], 1.0, 2e-3);
    EXPECT_NEAR(head.positions()[1], 1.0, 2e-3);
  }
}

}  // namespace
}  // namespace armature::janus
