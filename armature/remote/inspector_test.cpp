// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/inspector.hpp"

#include <thread>

#include "armature/remote/internal/test_robot.hpp"

namespace armature::remote {
namespace {

using ride::Access;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr ride::CallOptions kPatient{.deadline = 20s, .priority = {}};

class InspectorTest : public ::testing::Test {
 protected:
  explicit InspectorTest(TestRobot::Allows allows = {}) : robot_(std::move(allows)) {
    tool_.emplace(client_->connect(robot_.address()), Inspector::kName);
    EXPECT_TRUE(tool_->peer().wait_until_connected(20s).ok());
  }

  /// What an operation of the inspector answers.
  template <typename Answer, typename... Parameters, typename... Arguments>
  Answer ask(Answer (InspectorPlaceholder::*operation)(Parameters...), Arguments... arguments) {
    return robot_.serve([&] { return ((*tool_).*operation)(arguments..., kPatient); });
  }
  ItemValue value(const std::string& item) {
    return ask(&InspectorPlaceholder::read, std::vector<std::string>{item}).value().at(0);
  }
  std::string error_of_write(const std::string& item, const std::string& value) {
    return ask(&InspectorPlaceholder::write, item, value).error();
  }

  TestRobot robot_;
  std::optional<ride::Node> client_{std::in_place};
  std::optional<InspectorPlaceholder> tool_;
};

TEST_F(InspectorTest, TellsOfTheApplicationAndItsThreads) {
  robot_.pass(1s);
  const ApplicationStatus status = ask(&InspectorPlaceholder::application).value();
  EXPECT_EQ(status.name, "bench");
  EXPECT_TRUE(status.simulated);
  EXPECT_EQ(status.mode, "");
  EXPECT_DOUBLE_EQ(status.time, 1.0);
  ASSERT_EQ(status.threads.size(), 2u);
  EXPECT_EQ(status.threads[0].name, "Axis");
  EXPECT_EQ(status.threads[0].activity, "every 10 ms");
  EXPECT_EQ(status.threads[0].components, 1);
  EXPECT_EQ(status.threads[0].cycles, 100u);
  EXPECT_EQ(status.threads[0].skipped, 0u);
}

TEST_F(InspectorTest, TellsOfComponentsAndWhyTheyDoNotRun) {
  ASSERT_TRUE(robot_.application().stop_component("left.Axis"));
  const auto components = ask(&InspectorPlaceholder::components).value();
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].name, "Axis");
  EXPECT_EQ(components[0].model, "TestAxis");
  EXPECT_EQ(components[0].state, "Running");
  EXPECT_EQ(components[0].thread, "Axis");
  EXPECT_TRUE(components[0].autostart);
  EXPECT_NE(components[0].start_order, components[1].start_order);
  EXPECT_EQ(components[1].state, "Stopped");
  const Faults faults = ask(&InspectorPlaceholder::faults).value();
  EXPECT_EQ(faults.faults, 0u);
  ASSERT_EQ(faults.components.size(), 1u);
  EXPECT_EQ(faults.components[0].name, "left.Axis");
}

TEST_F(InspectorTest, EachComponentThatDoesNotRunHasItsOwnReason) {
  for (const char* name : {"Axis", "left.Axis"}) {
    component::Component& axis = *robot_.application().find(name);
    ASSERT_TRUE(robot_.application().run_in_thread_of(
        axis, [&] { axis.fault(std::string(name) + " is on fire"); }));
  }
  const auto components = ask(&InspectorPlaceholder::components).value();
  EXPECT_EQ(components.at(0).state + ": " + components[0].reason, "Exception: Axis is on fire");
  EXPECT_EQ(components.at(1).reason, "left.Axis is on fire");
  const Faults faults = ask(&InspectorPlaceholder::faults).value();
  EXPECT_EQ(faults.faults, 2u);
  EXPECT_EQ(faults.components.at(1).reason, "left.Axis is on fire");
}

TEST_F(InspectorTest, DescribesAComponentWithItsValues) {
  robot_.pass(10ms);
  const auto details = ask(&InspectorPlaceholder::describe, std::string("Axis")).value();
  EXPECT_EQ(details.status.model, "TestAxis");
  EXPECT_EQ(details.activity, "every 10 ms");
  EXPECT_TRUE(details.answered);
  const PropertyDetails& gain = details.properties.at(0);
  EXPECT_EQ(gain.name + gain.doc + gain.type + gain.unit + gain.value, "Gainof it alldoubleV2.5");
  EXPECT_TRUE(gain.limited && gain.changeable && gain.persistent);
  EXPECT_EQ(gain.high, 10.0);
  EXPECT_FALSE(details.properties.at(1).limited || details.properties.at(1).changeable);
  EXPECT_FALSE(details.properties.at(3).persistent) << "an attribute";
  EXPECT_FALSE(gain.by_operator);
  EXPECT_EQ(details.outputs.at(1).value, "[0, -0]");
  EXPECT_TRUE(details.outputs.at(1).written);
  EXPECT_FALSE(details.outputs.at(2).written);
  EXPECT_EQ(details.operations.at(0).signature,
            "double(const vector<double>& values, double factor)");
  EXPECT_EQ(details.operations.at(0).arguments.at(1).name, "factor");
  EXPECT_EQ(details.operations.at(0).result, "double");
  EXPECT_TRUE(details.operations.at(2).command);
  EXPECT_TRUE(details.operations.at(3).by_operator);
  ASSERT_EQ(details.fields.size(), 2u);
  EXPECT_EQ(
      details.fields[0].structure + "." + details.fields[0].name + " " + details.fields[0].unit,
      "TestGains.kp V/rad");
}

TEST_F(InspectorTest, ReadsValuesAndPartsOfThem) {
  robot_.pass(10ms);
  const auto values = ask(&InspectorPlaceholder::read,
                          std::vector<std::string>{"Axis.Both[2]", "Axis.Gains.kp", "Axis.Silent",
                                                   "left.Axis.Gain", "Axis.Both[3]", "Axsi.Gain"})
                          .value();
  ASSERT_EQ(values.size(), 6u);
  EXPECT_EQ(values[0].kind + " " + values[0].value + " " + values[0].unit, "output -0 m");
  EXPECT_EQ(values[1].kind + " " + values[1].value + " " + values[1].unit, "property 0.5 V/rad");
  EXPECT_FALSE(values[2].written);
  EXPECT_EQ(values[2].error, "");
  EXPECT_EQ(values[3].value, "2.5");
  EXPECT_EQ(values[4].error, "'Axis.Both' is a array<double,2> and has no '[3]'");
  EXPECT_EQ(values[5].error, "unknown component 'Axsi' (did you mean 'Axis'?)");
}

TEST_F(InspectorTest, ReadsSoManyValuesAtOnceAndNoMore) {
  const std::vector<std::string> many(Inspector::kMostItems, "Axis.Gain");
  EXPECT_EQ(ask(&InspectorPlaceholder::read, many).value().size(), many.size());
  const std::vector<std::string> too_many(Inspector::kMostItems + 1, "Axis.Gain");
  EXPECT_THAT(ask(&InspectorPlaceholder::read, too_many).error(),
              HasSubstr("at most 256 values are read at once, not 257"));
}

TEST_F(InspectorTest, SetsAPropertyInItsUnitOrAnother) {
  EXPECT_EQ(
      ask(&InspectorPlaceholder::write, std::string("Axis.Gain"), std::string("3")).value().value,
      "3");
  EXPECT_EQ(ask(&InspectorPlaceholder::write, std::string("Axis.Gain"), std::string("1500 mV"))
                .value()
                .value,
            "1.5");
  EXPECT_EQ(value("Axis.Gain").value, "1.5");
}

TEST_F(InspectorTest, WhatCannotBeSetIsToldAndLeftAsItWas) {
  EXPECT_THAT(error_of_write("Axis.Gain", "11"), HasSubstr("10"));
  EXPECT_THAT(error_of_write("Axis.Gain", "much"), HasSubstr("Axis.Gain: expected a double"));
  EXPECT_THAT(error_of_write("Axis.Gain", "1 rad"), HasSubstr("Axis.Gain: "));
  EXPECT_THAT(error_of_write("Axis.Fixed", "2"), HasSubstr("stop it first"));
  EXPECT_THAT(error_of_write("Axis.Position", "2"),
              HasSubstr("'Axis.Position' is a port: only components write it"));
  EXPECT_THAT(error_of_write("Axis.Gains.kp", "2"), HasSubstr("set the whole, Axis.Gains = ..."));
  EXPECT_THAT(error_of_write("Axis.Gian", "2"), HasSubstr("did you mean 'Gain'?"));
  EXPECT_EQ(value("Axis.Gain").value, "2.5");
}

TEST_F(InspectorTest, CallsOperations) {
  const auto call = [&](const std::string& operation, std::vector<std::string> arguments) {
    return ask(&InspectorPlaceholder::call, std::string("Axis"), operation, arguments);
  };
  const CallResult sum = call("sum", {"[1, 2]", "2"}).value();
  EXPECT_TRUE(sum.given);
  EXPECT_EQ(sum.type + " " + sum.value, "double 6");
  EXPECT_FALSE(call("note", {"a text, as it is"}).value().given);
  EXPECT_EQ(value("Axis.Note").value, "a text, as it is");
  EXPECT_THAT(call("sum", {"[1, 2]"}).error(),
              HasSubstr("Axis.sum takes 2 arguments, not 1: it is double("));
  EXPECT_THAT(call("sum", {"1", "2"}).error(), HasSubstr("Axis.sum: argument 1 (values): "));
  EXPECT_THAT(call("smu", {}).error(), HasSubstr("did you mean 'sum'?"));
  EXPECT_THAT(call("Gain", {}).error(),
              HasSubstr("'Axis.Gain' is neither an operation nor a command"));
}

TEST_F(InspectorTest, BeginsACommandAndFollowsIt) {
  const auto begin = [&](const std::string& target) {
    return ask(&InspectorPlaceholder::begin, std::string("Axis"), std::string("moveTo"),
               std::vector<std::string>{target});
  };
  CommandStatus motion = begin("5").value();
  EXPECT_EQ(motion.command + " " + motion.stage, "Axis.moveTo under way");
  EXPECT_FALSE(motion.ended);
  robot_.pass(100ms);
  motion = ask(&InspectorPlaceholder::follow, motion.handle).value();
  EXPECT_TRUE(motion.ended);
  EXPECT_EQ(motion.stage + motion.reason, "done");
  EXPECT_THAT(begin("-1").error(), HasSubstr("the target is below the axis"));
  EXPECT_THAT(ask(&InspectorPlaceholder::follow, std::int32_t{77}).error(),
              HasSubstr("unknown command handle 77"));
}

TEST_F(InspectorTest, CancelsACommand) {
  const auto motion = ask(&InspectorPlaceholder::begin, std::string("Axis"), std::string("moveTo"),
                          std::vector<std::string>{"1000"})
                          .value();
  robot_.pass(20ms);
  EXPECT_TRUE(ask(&InspectorPlaceholder::cancel, motion.handle).ok());
  robot_.pass(10ms);
  EXPECT_EQ(ask(&InspectorPlaceholder::follow, motion.handle).value().stage, "cancelled");
}

TEST_F(InspectorTest, ACommandIsCancelledWithTheConnectionThatBeganItAndWithNoOther) {
  const auto motion = ask(&InspectorPlaceholder::begin, std::string("Axis"), std::string("moveTo"),
                          std::vector<std::string>{"1000"})
                          .value();
  ride::Node other;
  InspectorPlaceholder watcher(other.connect(robot_.address()), Inspector::kName);
  const auto follow = [&] {
    return robot_.serve([&] { return watcher.follow(motion.handle, kPatient); }).value();
  };
  EXPECT_TRUE(watcher.peer().wait_until_connected(20s).ok());
  {
    ride::Node third;
    EXPECT_TRUE(third.connect(robot_.address()).wait_until_connected(20s).ok());
  }
  robot_.inspector().serve();
  robot_.pass(100ms);
  EXPECT_EQ(follow().stage, "under way");
  tool_.reset();
  client_.reset();
  for (int i = 0; i < 20'000 && follow().stage == "under way"; ++i) {
    robot_.inspector().serve();
    robot_.pass(10ms);
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(follow().stage, "cancelled");
  EXPECT_THAT(
      robot_.told(),
      HasSubstr("'Axis.moveTo' is cancelled: the connection to local, which began it, is lost"));
}

TEST_F(InspectorTest, AWatchIsSharedByWhoMayReadItAndEndsWithTheConnectionThatBeganIt) {
  const auto watch =
      ask(&InspectorPlaceholder::watch, std::vector<std::string>{"Axis.Position"}, 0.0).value();
  ride::Node other;
  InspectorPlaceholder watcher(other.connect(robot_.address()), Inspector::kName);
  EXPECT_TRUE(watcher.peer().wait_until_connected(20s).ok());
  const auto look = [&] {
    return robot_.serve([&] { return watcher.watched(watch.handle, kPatient); });
  };
  robot_.pass(100ms);
  EXPECT_EQ(look().value().values.size(), 1u);
  tool_.reset();
  client_.reset();
  for (int i = 0; i < 20'000 && look().ok(); ++i) {
    robot_.inspector().serve();
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_THAT(look().error(), HasSubstr("unknown watch"));
}

TEST_F(InspectorTest, KeepsNoMoreWatchesThanItsClientsNeed) {
  const auto watch = [&] {
    return ask(&InspectorPlaceholder::watch, std::vector<std::string>{"Axis.Position"}, 0.0);
  };
  const std::int32_t first = watch().value().handle;
  for (int i = 1; i < 16; ++i) EXPECT_TRUE(watch().ok());
  EXPECT_THAT(watch().error(), HasSubstr("16 watches of other processes are kept already"));
  EXPECT_TRUE(ask(&InspectorPlaceholder::end_watch, first).value());
  EXPECT_FALSE(ask(&InspectorPlaceholder::end_watch, first).value());
  EXPECT_TRUE(watch().ok());
  EXPECT_THAT(
      ask(&InspectorPlaceholder::watch, std::vector<std::string>{"Axis.Position"}, -1.0).error(),
      HasSubstr("an interval from 0 to 3600 s"));
  EXPECT_THAT(
      ask(&InspectorPlaceholder::watch, std::vector<std::string>(4097, "Axis.Position"), 0.0)
          .error(),
      HasSubstr("at most 4096 items"));
}

TEST_F(InspectorTest, SoIsTheWayToAStopThatItAskedFor) {
  ask(&InspectorPlaceholder::write, std::string("Axis.Loaded"), std::string("true")).value();
  const auto asked =
      ask(&InspectorPlaceholder::change, std::string("Axis"), std::string("stop")).value();
  EXPECT_EQ(asked.state, "Running") << "it goes where it may stop first";
  robot_.inspector().serve();
  robot_.pass(100ms);
  EXPECT_TRUE(robot_.application().is_on_way_to_stop("Axis"));
  tool_.reset();
  client_.reset();
  for (int i = 0; i < 20'000 && robot_.application().is_on_way_to_stop("Axis"); ++i) {
    robot_.inspector().serve();
    robot_.pass(10ms);
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_FALSE(robot_.application().is_on_way_to_stop("Axis"));
  EXPECT_EQ(robot_.application().find("Axis")->state(), component::State::kRunning);
}

TEST_F(InspectorTest, ForgetsTheOldestCommandThatHasEnded) {
  std::int32_t first = 0;
  for (std::size_t i = 0; i <= Inspector::kMostCommands; ++i) {
    const auto begun = ask(&InspectorPlaceholder::begin, std::string("Axis"), std::string("moveTo"),
                           std::vector<std::string>{"0"});
    ASSERT_TRUE(begun.ok()) << begun.error();
    if (i == 0) first = begun.value().handle;
    robot_.pass(10ms);
  }
  EXPECT_FALSE(ask(&InspectorPlaceholder::follow, first).ok());
  EXPECT_TRUE(ask(&InspectorPlaceholder::follow, first + 1).ok());
}

TEST_F(InspectorTest, AnActOfTheOperatorIsNotForOtherProcesses) {
  EXPECT_THAT(ask(&InspectorPlaceholder::begin, std::string("Axis"), std::string("arm"),
                  std::vector<std::string>{})
                  .error(),
              HasSubstr("'Axis.arm' is an act of the operator: another process may use it only if "
                        "the deployment grants it (grants: {remote: [Axis.arm]})"));
}

TEST_F(InspectorTest, ChangesTheStateOfAComponent) {
  const auto change = [&](const std::string& what) {
    return ask(&InspectorPlaceholder::change, std::string("Axis"), what);
  };
  EXPECT_EQ(change("stop").value().state, "Stopped");
  EXPECT_EQ(change("start").value().state, "Running");
  EXPECT_THAT(change("recover").error(), HasSubstr("Axis"));
  EXPECT_THAT(change("burn").error(), HasSubstr("reset, recover or cleanup, not 'burn'"));
}

TEST_F(InspectorTest, WhenTooManyRequestsWaitMoreAreRefused) {
  // Nobody runs the queue, so that what is asked for waits.
  std::vector<std::future<ride::Code>> asked;
  for (std::size_t i = 0; i <= Inspector::kMostWaiting; ++i) {
    asked.push_back(
        std::async(std::launch::async, [&] { return tool_->application(kPatient).code(); }));
  }
  std::size_t refused = 0;
  while (refused == 0) {
    for (auto& one : asked) {
      if (one.valid() && one.wait_for(1ms) == std::future_status::ready) {
        EXPECT_EQ(one.get(), ride::Code::kFailed);
        ++refused;
      }
    }
  }
  EXPECT_EQ(refused, 1u);
  for (auto& one : asked) {
    if (!one.valid()) continue;
    EXPECT_EQ(robot_.serve([&] { return one.get(); }), ride::Code::kNone);
  }
  EXPECT_TRUE(ask(&InspectorPlaceholder::application).ok()) << "there is room again";
}

TEST_F(InspectorTest, AFloodOfReadsCostsNoCycle) {
  std::atomic<bool> stop{false};
  std::atomic<int> read{0};
  std::vector<std::jthread> flood;
  for (int i = 0; i < 4; ++i) {
    flood.emplace_back([&] {
      while (!stop) read += tool_->read({"Axis.Position", "left.Axis.Both"}, kPatient).ok() ? 1 : 0;
    });
  }
  robot_.application().run_until(base::Time::max(), [&] { return read >= 2000; });
  stop = true;
  robot_.serve([&] {
    flood.clear();
    return true;
  });
  const auto cycles = (robot_.application().now() - base::Time{}) / base::Duration(10ms);
  const auto threads = robot_.application().thread_statistics();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(threads[i].cycles_skipped, 0u);
    EXPECT_EQ(static_cast<base::Duration::rep>(threads[i].cycles_run), cycles);
  }
}

/// Whose policy lets the tool do this and that.
class InspectorPolicy : public InspectorTest {
 protected:
  InspectorPolicy()
      : InspectorTest([this](const ride::AccessQuestion& question) {
          if (question.component == Inspector::kName) return question.access == Access::kRead;
          return question.component == "Axis" &&
                 allowed_[static_cast<std::size_t>(question.access)];
        }) {}
  ride::Code code_of(auto answer) { return answer.code(); }

  std::array<std::atomic<bool>, 3> allowed_{};
  const std::string axis_ = "Axis";
  const std::vector<std::string> none_;
};

TEST_F(InspectorPolicy, OnlyWhatMayBeReadIsListed) {
  EXPECT_EQ(ask(&InspectorPlaceholder::components).value().size(), 0u);
  allowed_[0] = true;
  const auto components = ask(&InspectorPlaceholder::components).value();
  ASSERT_EQ(components.size(), 1u);
  EXPECT_EQ(components[0].name, "Axis");
}

TEST_F(InspectorPolicy, EachAccessIsAskedForTheComponentItself) {
  const std::vector<std::string> item{"Axis.Gain"};
  const auto codes = [&] {
    const std::int32_t handle = 1;
    return std::vector<ride::Code>{
        ask(&InspectorPlaceholder::read, item).code(),
        ask(&InspectorPlaceholder::describe, axis_).code(),
        ask(&InspectorPlaceholder::begin, axis_, std::string("moveTo"),
            std::vector<std::string>{"1"})
            .code(),
        ask(&InspectorPlaceholder::follow, handle).code(),
        ask(&InspectorPlaceholder::cancel, handle).code(),
        ask(&InspectorPlaceholder::call, axis_, std::string("sum"),
            std::vector<std::string>{"[]", "1"})
            .code(),
        ask(&InspectorPlaceholder::write, item.front(), std::string("1")).code(),
        ask(&InspectorPlaceholder::change, axis_, std::string("stop")).code(),
        ask(&InspectorPlaceholder::change, axis_, std::string("start")).code()};
  };
  constexpr auto kYes = ride::Code::kNone;
  constexpr auto kNo = ride::Code::kNotAllowed;
  constexpr auto kNoHandle = ride::Code::kFailed;
  EXPECT_THAT(codes(), ElementsAre(kNo, kNo, kNo, kNoHandle, kNoHandle, kNo, kNo, kNo, kNo));
  allowed_[static_cast<std::size_t>(Access::kCommand)] = true;
  EXPECT_THAT(codes(), ElementsAre(kNo, kNo, kYes, kNo, kYes, kYes, kNo, kNo, kNo));
  robot_.pass(50ms);
  allowed_[static_cast<std::size_t>(Access::kCommand)] = false;
  allowed_[static_cast<std::size_t>(Access::kRead)] = true;
  EXPECT_THAT(codes(), ElementsAre(kYes, kYes, kNo, kYes, kNo, kNo, kNo, kNo, kNo));
  allowed_[static_cast<std::size_t>(Access::kRead)] = false;
  allowed_[static_cast<std::size_t>(Access::kConfigure)] = true;
  EXPECT_THAT(codes(), ElementsAre(kNo, kNo, kNo, kNo, kNo, kNo, kYes, kYes, kYes));
}

TEST_F(InspectorPolicy, AWatchIsForWhoMayReadAllThatItShows) {
  const auto watch = [&] {
    return ask(&InspectorPlaceholder::watch, std::vector<std::string>{"Axis.Position"}, 0.0);
  };
  EXPECT_EQ(watch().code(), ride::Code::kNotAllowed);
  allowed_[static_cast<std::size_t>(Access::kRead)] = true;
  const std::int32_t handle = watch().value().handle;
  EXPECT_TRUE(ask(&InspectorPlaceholder::watched, handle).ok());
  allowed_[static_cast<std::size_t>(Access::kRead)] = false;
  EXPECT_EQ(ask(&InspectorPlaceholder::watched, handle).code(), ride::Code::kNotAllowed);
  EXPECT_EQ(ask(&InspectorPlaceholder::end_watch, handle).code(), ride::Code::kNotAllowed);
}

TEST_F(InspectorPolicy, WhoMayOnlyReadHoldsUpNoTime) {
  EXPECT_TRUE(ask(&InspectorPlaceholder::pace).ok());
  EXPECT_EQ(ask(&InspectorPlaceholder::set_pace, Pace{1.0, true}).code(), ride::Code::kNotAllowed);
  EXPECT_EQ(ask(&InspectorPlaceholder::step).code(), ride::Code::kNotAllowed);
  EXPECT_FALSE(robot_.application().pace().paused);
}

TEST_F(InspectorPolicy, ARefusalNamesWhoAndWhatAndIsLogged) {
  const auto refused = ask(&InspectorPlaceholder::change, axis_, std::string("stop"));
  EXPECT_THAT(refused.error(), HasSubstr("local may not configure 'Axis'"));
  EXPECT_THAT(robot_.log(), HasSubstr("NOT_ALLOWED (local may not configure 'Axis')"));
  EXPECT_EQ(robot_.application().find("Axis")->state(), component::State::kRunning);
}

}  // namespace
}  // namespace armature::remote
