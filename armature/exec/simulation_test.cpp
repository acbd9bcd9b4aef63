// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/check.hpp"
#include "armature/exec/internal/test_components.hpp"
#include "armature/platform/stop_signal.hpp"

namespace armature::exec {
namespace {

using component::State;
using ::testing::ElementsAre;

constexpr base::Time at(base::Duration time) { return base::Time(time); }

/// Notes name and time of each update.
struct Scene {
  Journal journal;
  Blueprint blueprint;

  Probe& add(const char* name, Activity activity) {
    Probe& probe = blueprint.add<Probe>(name, std::move(activity));
    probe.actions["update"] = [this, &probe] { note(probe, ""); };
    probe.actions["in"] = [this, &probe] { note(probe, " in"); };
    return probe;
  }
  void note(const Probe& probe, const char* what) {
    journal.note(probe.name() + what + " " + std::to_string(probe.time().time_since_epoch() / 1ms));
  }
};

TEST(Simulation, RunsByTimeThenUrgencyThenDeclaration) {
  Scene scene;
  scene.add("Ordinary", Activity::periodic(2ms));
  scene.add("First40", Activity::periodic(3ms, 40));
  scene.add("Urgent", Activity::periodic(6ms, 90));
  scene.add("Second40", Activity::periodic(3ms, 40));
  Activity deadline = Activity::periodic(6ms);
  deadline.scheduler = Activity::Scheduler::kDeadline;
  deadline.budget = 1ms;
  scene.add("Deadline", deadline);
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(6ms);
  EXPECT_THAT(scene.journal.take(),
              ElementsAre("Ordinary 2", "First40 3", "Second40 3", "Ordinary 4", "Deadline 6",
                          "Urgent 6", "First40 6", "Second40 6", "Ordinary 6"));
}

TEST(Simulation, PassesAsRealTimeOnceDid) {
  Scene scene;
  scene.add("Recorded", Activity::periodic(2ms));
  scene.add("Periodic", Activity::periodic(2ms));
  ApplicationOptions options = patient(true);
  options.instants = {at(100ms), {{"Recorded", {at(101ms), at(105ms), at(106ms)}}}};
  Application application(std::move(scene.blueprint), std::move(options));
  EXPECT_EQ(application.now(), at(100ms));
  ASSERT_TRUE(application.start().ok());
  application.run_for(8ms);
  EXPECT_THAT(scene.journal.take(),
              ElementsAre("Recorded 101", "Periodic 102", "Periodic 104", "Recorded 105",
                          "Recorded 106", "Periodic 106", "Periodic 108"));
}

/// Drives what its bus is, once it has one.
class OnABus final : public component::Component {
 public:
  using Component::Component;
  void on_check(component::Check& check) const override {
    if (!bus_.get().empty()) check.drives_hardware(bus_.get());
  }

 private:
  component::Property<std::string> bus_{this, "bus", "", "the bus"};
};

TEST(Simulation, NobodyIsConfiguredAnewToDriveARealRobot) {
  Blueprint blueprint;
  blueprint.add<OnABus>("Drive", Activity::periodic(1ms));
  Application application(std::move(blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  const auto start_anew = [&](const std::string& bus) {
    EXPECT_TRUE(application.stop_component("Drive"));
    EXPECT_TRUE(application.clean_up_component("Drive"));
    EXPECT_TRUE(application.set_property("Drive", "bus", types::Value::of(bus)).ok());
    return application.start_component("Drive");
  };
  EXPECT_TRUE(start_anew(""));
  const auto refused = start_anew("can0");
  EXPECT_FALSE(refused);
  EXPECT_THAT(std::string(refused.reason()),
              ::testing::HasSubstr("'Drive' drives a real robot by can0"));
  EXPECT_FALSE(application.find("Drive")->is_configured());
  EXPECT_TRUE(application.set_property("Drive", "bus", types::Value::of(std::string())).ok());
  EXPECT_TRUE(application.start_component("Drive"));
}

TEST(Simulation, ATriggeredThreadRunsAtTheTimeOfItsTriggerWhenItsTurnComes) {
  Scene scene;
  Probe& fast = scene.add("Fast", Activity::periodic(1ms, 50));
  scene.add("Other", Activity::periodic(1ms, 30));
  scene.add("Triggered", Activity::triggered(40));
  scene.blueprint.connect("Fast.Out", "Triggered.In");
  fast.actions["update"] = [&] {
    scene.note(fast, "");
    fast.out.write(1.0);
  };
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(2ms);
  EXPECT_THAT(scene.journal.take(), ElementsAre("Fast 1", "Triggered in 1", "Other 1", "Fast 2",
                                                "Triggered in 2", "Other 2"));
}

TEST(Simulation, WhatIsDueAtTheEndOfARunBelongsToIt) {
  Scene scene;
  scene.add("A", Activity::periodic(1ms));
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  for (int i = 0; i < 3; ++i) application.run_for(500us);
  EXPECT_EQ(application.now(), at(1500us));
  EXPECT_THAT(scene.journal.take(), ElementsAre("A 1"));
  application.run_for(500us);
  EXPECT_THAT(scene.journal.take(), ElementsAre("A 2"));
  application.run_for(0ms);
  EXPECT_THAT(scene.journal.take(), ElementsAre());
}

TEST(Simulation, TimeGoesOnAfterAStop) {
  Scene scene;
  scene.add("A", Activity::periodic(1ms));
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1500us);
  EXPECT_TRUE(application.stop().ok());
  ASSERT_TRUE(application.start().ok());
  application.run_for(1ms);
  EXPECT_EQ(application.now(), at(2500us));
  EXPECT_THAT(scene.journal.take(), ElementsAre("A 1", "A 2"));
}

TEST(Simulation, YearsWithNothingToDoTakeNoTime) {
  Scene scene;
  scene.add("A", Activity::triggered());
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(std::chrono::hours(24 * 365 * 100)), RunEnd::kTimeUp);
  EXPECT_EQ(application.now(), at(std::chrono::hours(24 * 365 * 100)));
}

TEST(Simulation, DataThatBecomesTooOldIsNoticedAtItsTime) {
  Scene scene;
  Probe& writer = scene.add("Writer", Activity::periodic(10ms));
  Probe& reader = scene.add("Reader", Activity::triggered());
  scene.blueprint.connect("Writer.Out", "Reader.In");
  scene.blueprint.connections[0].max_age = component::max_age(25ms);
  int writes = 3;
  writer.actions["update"] = [&] {
    if (writes-- > 0) writer.out.write(1.0);
  };
  base::Time stopped_at;
  reader.actions["stop"] = [&] { stopped_at = reader.time(); };
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1s);
  EXPECT_EQ(reader.state(), State::kStopped);
  EXPECT_EQ(stopped_at, at(30ms + 25ms + 1ns));
}

TEST(Simulation, ThreadsThatTriggerEachOtherWithoutEndAreTakenOutOfService) {
  Scene scene;
  Probe& a = scene.add("A", Activity::triggered());
  Probe& b = scene.add("B", Activity::triggered());
  Probe& source = scene.add("Source", Activity::periodic(1ms));
  class Join final : public component::Component {
   public:
    using Component::Component;
    component::InputPort<double> in{
        this, "In", "two writers", "", component::on_data<&Join::on_in>, component::fan_in};
    component::OutputPort<double> out{this, "Out", "hands it on"};

   private:
    void on_in() { out.write(1.0); }
  };
  scene.blueprint.add<Join>("Join", Activity::triggered());
  scene.blueprint.connect("Source.Out", "Join.In");
  scene.blueprint.connect("Join.Out", "A.In");
  scene.blueprint.connect("A.Out", "B.In");
  scene.blueprint.connect("B.Out", "Join.In");
  source.actions["update"] = [&] { source.out.write(1.0); };
  a.actions["in"] = [&] { a.out.write(1.0); };
  b.actions["in"] = [&] { b.out.write(1.0); };
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(application.run_for(10ms), RunEnd::kTimeUp) << "time goes on";
  EXPECT_EQ(application.faults(), 1u);
  EXPECT_EQ(source.state(), State::kRunning);
  EXPECT_TRUE(application.stop().ok());
  EXPECT_EQ(application.casualties().at(0).reason,
            "simulated time stands still: threads trigger each other without end");
}

TEST(Simulation, AThousandIdleThreadsAndComponentsAreLeftAlone) {
  Scene scene;
  scene.add("Busy", Activity::periodic(1ms));
  for (int i = 0; i < 1000; ++i) {
    const std::string number = std::to_string(i);
    scene.add(("Idle" + number).c_str(), Activity::triggered());
    scene.add(("Guest" + number).c_str(), Activity::sequential());
    scene.blueprint.connect("Idle" + number + ".Out", "Guest" + number + ".In");
  }
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1s);
  EXPECT_EQ(scene.journal.take().size(), 1000u);
  for (const ThreadStatistics& thread : application.thread_statistics()) {
    EXPECT_EQ(thread.cycles_run, thread.name == "Busy" ? 1000u : 0u);
  }
}

/// A run of two threads whose tools are asked at each `attend`.
class PacedSimulation : public testing::Test {
 protected:
  void start(const Pace& pace) {
    scene_.add("Fast", Activity::periodic(1ms));
    scene_.add("Slow", Activity::periodic(3ms));
    ApplicationOptions options = patient(true);
    options.pace = pace;
    options.attend = [this] {
      ++attended_;
      if (tool_) tool_();
    };
    application_.emplace(std::move(scene_.blueprint), std::move(options));
    ASSERT_TRUE(application_->start().ok());
  }

  Scene scene_;
  int attended_ = 0;
  std::function<void()> tool_;
  std::optional<Application> application_;
};

TEST_F(PacedSimulation, DoesWhatAFastOneDoes) {
  start({.rate = 50.0});
  EXPECT_EQ(application_->run_for(3ms), RunEnd::kTimeUp);
  EXPECT_THAT(scene_.journal.take(), ElementsAre("Fast 1", "Fast 2", "Fast 3", "Slow 3"));
}

TEST_F(PacedSimulation, PausedTimePassesByStepsOnlyAndToolsAreAttendedTo) {
  start({.paused = true});
  tool_ = [this] {
    if (attended_ == 10) EXPECT_THAT(scene_.journal.take(), ElementsAre());
    if (attended_ == 10 || attended_ == 20) EXPECT_TRUE(application_->step());
    if (attended_ == 30) {
      EXPECT_EQ(application_->now(), at(2ms));
      EXPECT_THAT(scene_.journal.take(), ElementsAre("Fast 1", "Fast 2"));
      EXPECT_TRUE(application_->set_pace({}));
    }
  };
  EXPECT_EQ(application_->run_for(4ms), RunEnd::kTimeUp);
  EXPECT_THAT(scene_.journal.take(), ElementsAre("Fast 3", "Slow 3", "Fast 4"));
  EXPECT_GE(attended_, 30);
}

TEST_F(PacedSimulation, ValuesOfAPausedApplicationAreReadAndSet) {
  start({.paused = true});
  tool_ = [this] {
    if (attended_ != 3) return;
    EXPECT_TRUE(application_->stop_component("Slow"));
    EXPECT_EQ(application_->find("Slow")->state(), State::kStopped);
    EXPECT_TRUE(application_->set_pace({}));
  };
  application_->run_for(3ms);
  EXPECT_THAT(scene_.journal.take(), ElementsAre("Fast 1", "Fast 2", "Fast 3"));
}

TEST_F(PacedSimulation, ASignalEndsAPause) {
  start({.paused = true});
  const platform::StopSignal stop;
  tool_ = [this] {
    if (attended_ == 5) std::raise(SIGTERM);
  };
  EXPECT_EQ(application_->run_for(1h, &stop), RunEnd::kStopRequested);
  EXPECT_EQ(application_->now(), at(0ms));
}

TEST_F(PacedSimulation, RefusesWhatIsNoPaceAndStepsWithoutAPause) {
  start({});
  EXPECT_FALSE(application_->set_pace({.rate = 0.0}));
  EXPECT_FALSE(application_->set_pace({.rate = std::nan("")}));
  EXPECT_FALSE(application_->step());
  EXPECT_EQ(application_->pace(), Pace{});
}

/// Drives what is not simulated.
class Drive : public component::Component {
 public:
  using Component::Component;

 private:
  void on_check(component::Check& check) const override { check.drives_hardware("can0"); }
};

TEST(Simulation, ARealRobotDoesNotFollowIt) {
  for (const bool simulated : {true, false}) {
    Blueprint blueprint;
    blueprint.add<Drive>("Drive", Activity::periodic(1ms));
    Application application(std::move(blueprint), patient(simulated));
    const std::string said = application.start().to_text();
    EXPECT_EQ(application.running(), !simulated);
    EXPECT_EQ(said.find("'Drive' drives a real robot by can0") != said.npos, simulated) << said;
  }
}

TEST(Simulation, IsRealTimeForTheGuard) {
  Scene scene;
  Probe& probe = scene.add("A", Activity::periodic(1ms));
  int depth = 0;
  probe.actions["update"] = [&] { depth = rt::guard_state().realtime_depth; };
  Application application(std::move(scene.blueprint), patient(true));
  ASSERT_TRUE(application.start().ok());
  application.run_for(1ms);
  EXPECT_GT(depth, 0);
  EXPECT_EQ(rt::guard_state().realtime_depth, 0);
}

}  // namespace
}  // namespace armature::exec
