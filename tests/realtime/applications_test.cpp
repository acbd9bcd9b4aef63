// SPDX-License-Identifier: Apache-2.0
// Whole applications under the guard: everything that happens between start and stop.
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/modes.hpp"
#include "armature/platform/clock.hpp"
#include "armature/testing/realtime_guard.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::exec {
namespace {

using component::CommandHandle;
using component::Component;
using component::EventHandler;
using component::Outcome;
using std::chrono::milliseconds;

/// With everything on that looks at an application.
void watch(ApplicationOptions& options) {
  options.timeline.sink = [](const TimelineSlice&) {};
  options.black_box.write = [](const BlackBoxReport&) { return std::string(); };
}

/// Measures, alarms, logs, and stops now and then for longer than its period.
class Sensor final : public Component {
 public:
  using Component::Component;
  Sensor* slow_every(int cycles) {
    slow_every_ = cycles;
    return this;
  }

 private:
  void on_update() override {
    ++cycles_;
    values_.write(sample_);
    if (cycles_ % 4 == 0) alarm_.raise(1.5, cycles_);
    if (cycles_ % 8 == 0) log_info("cycle {} of {}", cycles_, name());
    if (slow_every_ > 0 && cycles_ % slow_every_ == 0) be_late();
  }
  void be_late() {
    const base::Time end = platform::monotonic_now() + milliseconds(3);
    while (platform::monotonic_now() < end) {
    }
  }
  // Runs in its callers' threads, so it keeps off the property, which may change in this one.
  static constexpr double kScale = 2.0;
  double scale(double value) { return value * kScale; }

  int cycles_ = 0;
  int slow_every_ = 0;
  std::vector<double> sample_ = std::vector<double>(7, 1.0);
  component::Property<double> factor_{this, "Factor", 2.0,
                                      "",   "",       component::changeable_while_running};
  component::OutputPort<std::vector<double>> values_{this, "Values", "", "",
                                                     component::fixed_size(7)};
  component::Event<double, int> alarm_{this, "Alarm", ""};
  component::Operation<double(double)> scale_{this, "scale", component::serve<&Sensor::scale>, ""};
};

/// Moves on command, with a state machine.
class Drive final : public Component {
 public:
  using Component::Component;
  int moves = 0;

 private:
  Outcome begin_move(double target) {
    target_ = target;
    begun_.raise();
    return component::accepted();
  }
  bool arrived() { return position_ >= target_; }
  void advance() { position_ += 0.5; }
  void count_move() {
    ++moves;
    position_ = 0.0;
  }
  double position() { return position_; }

  double target_ = 0.0;
  double position_ = 0.0;
  component::Trigger begun_{"begun"};
  component::Command<double> move_{this, "move", component::serve<&Drive::begin_move>, "",
                                   component::done_when<&Drive::arrived>};
  component::Operation<double()> get_{this, "position", component::serve<&Drive::position>, "",
                                      component::in_own_thread};
  component::StateMachine mode_{
      this, "mode", "", component::in_state("Idle", component::on(begun_, component::to("Moving"))),
      component::in_state(
          "Moving", component::entering<&Drive::count_move>, component::during<&Drive::advance>,
          component::in_state("Starting", component::after(milliseconds(2), component::to("On"))),
          component::in_state("On", component::when<&Drive::arrived>(component::to("Idle"))))};
};

/// Reads every value, reacts to alarms, calls and commands its peers.
class Controller final : public Component {
 public:
  using Component::Component;
  int alarms = 0;
  double sum = 0.0;

 private:
  /// What was sent in the run before is forgotten here, where memory may be given back.
  Outcome on_start() override {
    move_sent_ = CommandHandle(component::CallStatus::kPending);
    position_asked_ = component::SendHandle<double>(component::CallStatus::kPending);
    return component::accepted();
  }
  void handle(const std::vector<double>& values) {
    sum += values.front() + scale_(1.0).value;
    if (!move_sent_.sent() || move_sent_.ended()) move_sent_ = move_.send(2.0);
    position_asked_ = position_.send();
    log_debug("sum {}", sum);
  }
  void hear(const double&, const int&) { ++alarms; }

  CommandHandle move_sent_{component::CallStatus::kPending};
  component::SendHandle<double> position_asked_{component::CallStatus::kPending};
  component::InputPort<std::vector<double>> values_{this,
                                                    "Values",
                                                    "",
                                                    "",
                                                    component::on_data<&Controller::handle>,
                                                    component::max_age(std::chrono::seconds(10))};
  component::OperationCaller<double(double)> scale_{this, "scale", ""};
  component::OperationCaller<double()> position_{this, "position", ""};
  component::CommandCaller<double> move_{this, "move", ""};
  EventHandler<double, int> on_alarm_{this, "Alarm", component::serve<&Controller::hear>, ""};
};

struct Arrangement {
  std::string name;
  Activity sensor;
  Activity controller;
  Activity drive;
  component::ConnectionPolicy::Kind kind;
  bool simulated;
};

void PrintTo(const Arrangement& arrangement, std::ostream* to) { *to << arrangement.name; }

std::vector<Arrangement> arrangements(bool simulated) {
  const Activity periodic = Activity::periodic(milliseconds(1), 30);
  using Kind = component::ConnectionPolicy::Kind;
  std::vector<Arrangement> all;
  all.push_back({"OneThread", periodic, Activity::sequential(), Activity::sequential(),
                 Kind::kLatest, simulated});
  all.push_back(
      {"TriggeredThread", periodic, Activity::triggered(20), periodic, Kind::kLatest, simulated});
  all.push_back({"FifoToTriggeredThread", periodic, Activity::triggered(20), periodic, Kind::kFifo,
                 simulated});
  return all;
}

class Applications : public ::testing::TestWithParam<Arrangement> {
 protected:
  Applications() {
    Blueprint blueprint;
    sensor_ = &blueprint.add<Sensor>("sensor", GetParam().sensor);
    controller_ = &blueprint.add<Controller>("controller", GetParam().controller);
    drive_ = &blueprint.add<Drive>("drive", GetParam().drive);
    component::ConnectionPolicy policy;
    policy.kind = GetParam().kind;
    policy.capacity = 4;
    blueprint.connect("sensor.Values", "controller.Values", policy);
    blueprint.add_peer("controller", "sensor");
    blueprint.add_peer("controller", "drive");
    ApplicationOptions options;
    options.simulated = GetParam().simulated;
    options.measure_every = 2;
    options.log = [this](const rt::LogRecord&) { ++log_lines_; };
    watch(options);
    application_ = std::make_unique<Application>(std::move(blueprint), std::move(options));
  }

  void start() {
    const base::Diagnostics diagnostics = application_->start();
    ASSERT_TRUE(diagnostics.ok()) << diagnostics.to_text();
  }
  /// Runs until the sensor's thread has run so many cycles more.
  void run_cycles(std::uint64_t cycles) {
    const auto run = [this] { return application_->thread_statistics().front().cycles_run; };
    const std::uint64_t end = run() + cycles;
    while (run() < end) application_->run_for(milliseconds(5));
  }

  testing::RealtimeGuard guard_;
  std::unique_ptr<Application> application_;
  Sensor* sensor_ = nullptr;
  Controller* controller_ = nullptr;
  Drive* drive_ = nullptr;
  int log_lines_ = 0;
};

const auto name_of_arrangement = [](const auto& each) { return each.param.name; };
INSTANTIATE_TEST_SUITE_P(RealTime, Applications, ::testing::ValuesIn(arrangements(false)),
                         name_of_arrangement);
INSTANTIATE_TEST_SUITE_P(SimulatedTime, Applications, ::testing::ValuesIn(arrangements(true)),
                         name_of_arrangement);

TEST_P(Applications, RunWithoutAViolation) {
  start();
  run_cycles(100);
  application_->stop();
  EXPECT_EQ(guard_.violations(), 0u) << "Engine::serve"
                                     << ": " << guard_.report();
  EXPECT_GT(controller_->sum, 0.0);
  EXPECT_GT(controller_->alarms, 0);
  EXPECT_GT(log_lines_, 0);
}

TEST_P(Applications, StayWithoutAViolationWhenToolsInterfere) {
  start();
  run_cycles(10);
  EXPECT_TRUE(application_->set_property("sensor", "Factor", types::Value::of(3.0)));
  EXPECT_TRUE(application_->value_of("sensor", "Values"));
  EXPECT_TRUE(application_->call("sensor", "scale", {types::Value::of(1.0)}));
  EXPECT_TRUE(application_->stop_component("controller"));
  run_cycles(10);
  EXPECT_TRUE(application_->start_component("controller"));
  run_cycles(10);
  application_->stop();
  EXPECT_EQ(guard_.violations(), 0u) << guard_.report();
}

/// Simulated time is never late.
class ApplicationsInRealTime : public Applications {};

INSTANTIATE_TEST_SUITE_P(RealTime, ApplicationsInRealTime, ::testing::ValuesIn(arrangements(false)),
                         name_of_arrangement);

TEST_P(ApplicationsInRealTime, MissCyclesWithoutAViolation) {
  sensor_->slow_every(10);
  start();
  run_cycles(50);
  EXPECT_GT(application_->thread_statistics().front().cycles_skipped, 0u);
  application_->stop();
  EXPECT_EQ(guard_.violations(), 0u) << guard_.report();
}

TEST_P(Applications, StartAgainWithoutAViolation) {
  for (int i = 0; i < 2; ++i) {
    start();
    run_cycles(10);
    application_->stop();
  }
  EXPECT_EQ(guard_.violations(), 0u) << guard_.report();
}

/// Fails in its tenth cycle, in the way that is asked for.
class Failing final : public Component {
 public:
  using Component::Component;
  bool throws = false;
  int updates = 0;

 private:
  void on_update() override {
    if (++updates != 10) return;
    if (throws) throw std::runtime_error("the encoder's answer made no sense, again and again");
    fault("the encoder does not answer");
  }
  component::OutputPort<double> out_{this, "Out", ""};
};

class Dependent final : public Component {
 public:
  using Component::Component;

 private:
  component::InputPort<double> in_{this, "In", ""};
};

/// In real time, or in simulated time.
class Failures : public ::testing::TestWithParam<bool> {
 protected:
  /// Runs until the component has failed.
  void run(bool throws) {
    Blueprint blueprint;
    auto& failing = blueprint.add<Failing>("failing", Activity::periodic(milliseconds(1)));
    failing.throws = throws;
    blueprint.add<Dependent>("dependent", Activity::periodic(milliseconds(1)));
    blueprint.connect("failing.Out", "dependent.In");
    ApplicationOptions options;
    options.simulated = GetParam();
    watch(options);
    Application application(std::move(blueprint), std::move(options));
    ASSERT_TRUE(application.start().ok());
    while (application.faults() == 0) application.run_for(milliseconds(5));
    application.run_for(milliseconds(5));
    EXPECT_EQ(failing.state(), component::State::kException);
    application.stop();
  }
  testing::RealtimeGuard guard_;
};

INSTANTIATE_TEST_SUITE_P(Time, Failures, ::testing::Bool(), [](const auto& each) {
  return std::string(each.param ? "Simulated" : "Real");
});

TEST_P(Failures, AreContainedWithoutAViolation) {
  run(false);
  EXPECT_EQ(guard_.violations(), 0u) << "Supervisor"
                                     << ": " << guard_.report();
}

TEST_P(Failures, ByExceptionAreOneViolationWhateverItTakesToContainThem) {
  if (!std::string_view(ARMATURE_SANITIZER).empty()) GTEST_SKIP() << "a sanitizer hides the throw";
  run(true);
  EXPECT_EQ(guard_.violations(), 1u) << guard_.report();
  EXPECT_THAT(guard_.report(),
              ::testing::HasSubstr("'failing' in thread 'failing' threw std::runtime_error"));
}

/// Writes where others do, too, and goes on from what they wrote.
class Turn final : public Component {
 public:
  using Component::Component;
  int taken = 0;

 private:
  Outcome on_start() override {
    if (const std::vector<double>* const present = out_.taken_over()) {
      values_ = *present;
      ++taken;
    }
    return component::accepted();
  }
  void step(const std::vector<double>&) { out_.write(values_); }

  std::vector<double> values_ = std::vector<double>(7, 1.0);
  component::InputPort<std::vector<double>> in_{
      this, "In", "", "", component::on_data<&Turn::step>, component::fixed_size(7)};
  component::OutputPort<std::vector<double>> out_{this, "Out", "", "", component::fixed_size(7)};
};

class Reader final : public Component {
 public:
  using Component::Component;
  component::InputPort<std::vector<double>> in{this, "In", "", ""};
};

/// Asks for the other mode every few cycles.
class Switcher final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    if (++cycles_ % 7 == 0) sent_ = switch_.send(ModeName(cycles_ % 14 == 0 ? "one" : "two"));
  }
  int cycles_ = 0;
  CommandHandle sent_{component::CallStatus::kPending};
  component::CommandCaller<ModeName> switch_{this, "switch", ""};
};

TEST_P(Failures, AreNotWhatASwitchOfModesIs) {
  Blueprint blueprint;
  blueprint.add<Sensor>("sensor", Activity::periodic(milliseconds(1), 30));
  auto& first = blueprint.add<Turn>("first");
  auto& second = blueprint.add<Turn>("second");
  blueprint.add<Reader>("reader");
  blueprint.add<Switcher>("switcher", Activity::periodic(milliseconds(2), 20));
  for (const char* turn : {"first", "second"}) {
    blueprint.connect("sensor.Values", std::string(turn) + ".In");
    blueprint.connect(std::string(turn) + ".Out", "reader.In");
  }
  blueprint.add_mode("one", {{"first", {}}});
  blueprint.add_mode("two", {{"second", {}}});
  blueprint.add_peer("switcher", "Modes");
  ApplicationOptions options;
  options.simulated = GetParam();
  Application application(std::move(blueprint), std::move(options));
  const testing::RealtimeGuard guard;
  ASSERT_TRUE(application.start().ok());
  while (application.thread_statistics().front().cycles_run < 200) {
    application.run_for(milliseconds(5));
  }
  application.stop();
  EXPECT_EQ(guard.violations(), 0u) << "Modes"
                                    << ": " << guard.report();
  EXPECT_GT(first.taken, 3);
  EXPECT_GT(second.taken, 3);
}

TEST(SimulatedTime, AnEngineStepsWithoutAViolation) {
  Sensor sensor("sensor");
  Engine engine("loop", Activity::periodic(milliseconds(1)), {&sensor}, {&sensor});
  engine.context().simulated = true;
  ASSERT_TRUE(component::Host::configure(sensor));
  ASSERT_TRUE(component::Host::start(sensor));
  base::Time now{};
  engine.begin(now);
  expect_realtime("Engine::step", [&] { engine.step(now += milliseconds(1)); });
  EXPECT_EQ(engine.cycles_run(), 101u);
  expect_realtime("Engine::fault_members", [&] { engine.fault_members("the thread is late"); });
  EXPECT_EQ(sensor.state(), component::State::kException);
}

}  // namespace
}  // namespace armature::exec
