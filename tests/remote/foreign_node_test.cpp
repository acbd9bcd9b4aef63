// SPDX-License-Identifier: Apache-2.0
// A deployment that uses a component of a program without Armature's runtime, by its interface
// file alone: the program is a node with a service that rcidl made.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/general/controls/request.hpp"
#include "armature/general/controls/sequence.hpp"
#include "armature/remote/placeholder.hpp"
#include "armature/ride/node.hpp"
#include "armature/testing/kept_port.hpp"
#include "lift_service.hpp"
#include "tests/remote/processes.hpp"

namespace armature::remote {
namespace {

using namespace test;
using ::testing::HasSubstr;

/// The one without any component: travels at once.
class Lift final : public lift::LiftService {
 public:
  void travel(double height, bool quickly) override {
    if (quickly) throw ride::Failure("the rope is worn");
    height_ = height;
    ++travels_;
  }
  void cancel_travel() override {}
  void stop() override { ++stops_; }
  void open(const std::vector<double>& times) override { opened_ = times.size(); }
  /// Waits for the test at first; the third person is too heavy.
  void enter(double weight) override {
    std::unique_lock lock(mutex_);
    ++waits_;
    opens_.wait_for(lock, std::chrono::seconds(30), [this] { return is_open_; });
    entered_.push_back(weight);
    if (entered_.size() == 3) throw ride::Failure("it is full");
  }
  void open_the_door() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    opens_.notify_all();
  }
  std::vector<double> entered() {
    const std::lock_guard lock(mutex_);
    return entered_;
  }
  void Load(double value) override { load_ = value; }
  std::int32_t add(std::int32_t a, std::int32_t b) override { return a + b; }
  std::string describe(lift::Mode mode, const std::array<double, 2>& range,
                       const std::vector<std::int32_t>& floors) override {
    return std::string(types::name_of(mode)) + " from " + std::to_string(int(range[0])) + " to " +
           std::to_string(int(range[1])) + ", floors: " + std::to_string(floors.size());
  }
  using LiftService::raise;

  std::atomic<double> height_{0.0};
  std::atomic<int> travels_{0};
  std::atomic<int> stops_{0};
  std::atomic<std::size_t> opened_{0};
  std::atomic<double> load_{0.0};
  std::atomic<int> waits_{0};

 private:
  std::mutex mutex_;
  std::condition_variable opens_;
  bool is_open_ = false;
  std::vector<double> entered_;
};

/// One of the application's own: raises its event when the test asks for it.
class Cabin final : public Component {
 public:
  using Component::Component;

  std::atomic<int> press{0};
  std::atomic<double> came{0.0};
  std::atomic<bool> quickly{false};
  std::atomic<double> height{0.0};
  std::atomic<int> gone{0};

 private:
  void on_update() override {
    wish_.write(2.5);
    weight_.write(80.0 + presses_);
    if (press > 0) {
      --press;
      ++presses_;
      pressed_.raise();
    }
  }
  Outcome come(double to, bool fast) {
    came = to;
    quickly = fast;
    come_.complete();
    return accepted();
  }
  void note(double value) { height = value; }

  int presses_ = 0;
  component::OutputPort<double> wish_{this, "Wish", "where to", "m"};
  component::OutputPort<double> weight_{this, "Weight", "in it", "kg"};
  component::InputPort<double> height_in_{this,
                                          "Height",
                                          "where it is",
                                          "m",
                                          component::on_data<&Cabin::note>,
                                          component::may_stay_open,
                                          component::on_lost(component::Reaction::kHold)};
  component::Event<> pressed_{this, "Pressed", "its button", component::occasional};
  component::Command<double, bool> come_{this, "come", serve<&Cabin::come>, "comes",
                                         component::args("height [m]", "quickly")};
};

/// Calls an operation and waits, by the types that C++ has: from a thread of its own, or from that
/// of the placeholder, whose event it handles.
class Caller final : public Component {
 public:
  using Component::Component;

  std::atomic<int> sum{0};
  std::atomic<int> called{0};

 private:
  void on_update() override { sum = add_(3, 4).value; }
  void handle(double, bool) {
    const auto answer = add_(20, 22);
    if (answer) called = answer.value;
  }

  component::OperationCaller<int(int, int)> add_{this, "add", "adds"};
  component::EventHandler<double, bool> called_{this, "Called", serve<&Caller::handle>,
                                                "somebody waits"};
};

/// Would add what the lift does not.
class Other final : public Component {
 public:
  using Component::Component;

 private:
  component::OperationCaller<double(double, double)> add_{this, "add", "adds"};
};

/// The other process: a node, which listens where the one before it did.
struct Foreign {
  explicit Foreign(const std::string& address = "tcp://127.0.0.1:0",
                   const std::string& name = "Lift") {
    EXPECT_TRUE(node.add(name, lift));
    const auto listens = node.listen(address);
    EXPECT_TRUE(listens) << listens.error();
    if (listens) at = listens.value().text();
  }
  Lift lift;
  ride::Node node;
  std::string at;
};

const std::string kFile = std::string(REMOTE_TESTDATA) + "/lift.idl";

struct ByInterfaceFile : ::testing::Test {
  static void add_models(component::Registry& models) {
    models.add<Cabin>("Cabin", "");
    models.add<Caller>("Caller", "");
    models.add<Other>("Other", "");
    models.add<general::Request>("Request", "");
    models.add<general::Sequence>("Sequence", "");
  }
  static std::string components(const std::string& address, const std::string& interface = kFile) {
    return "components:\n  Lift: {remote: '" + address + "/Lift', interface: '" + interface +
           "'}\n  Cabin: {model: Cabin, activity: {periodic: 2 ms}}\n";
  }
  void start(const std::string& connections, const std::string& address) {
    application =
        std::make_unique<Process>(components(address) + "connections:\n" + connections, add_models);
    application->start();
    cabin = &application->find<Cabin>("Cabin");
  }
  void start(const std::string& connections) {
    foreign = std::make_unique<Foreign>();
    start(connections, foreign->at);
  }
  static std::string mistakes(const std::string& yaml) {
    return Process(yaml, add_models).deployment.diagnostics.to_text();
  }
  bool until(const std::function<bool()>& condition) const {
    return serve_until({application.get()}, condition);
  }
  bool until_logged(const std::string& text) const {
    return until([&] { return application->log.find(text) != std::string::npos; });
  }
  std::string text_of(const char* component, const char* item) const {
    return application->application->value_of(component, item).value().text();
  }
  base::Result<std::optional<types::Value>> call(const std::string& operation,
                                                 const std::vector<types::Value>& arguments) const {
    return application->application->call("Lift", operation, arguments, exec::Caller::kOperator);
  }

  std::unique_ptr<Foreign> foreign;
  std::unique_ptr<Process> application;
  Cabin* cabin = nullptr;
};

TEST_F(ByInterfaceFile, ItsEventCommandsAComponentHere) {
  start("  - Lift.Called -> Cabin.come\n");
  EXPECT_TRUE(until([&] {
    foreign->lift.raise(lift::Called{3.5, true});
    return cabin->came == 3.5;
  }));
  EXPECT_TRUE(cabin->quickly);
}

TEST_F(ByInterfaceFile, AnEventHereCommandsItWithParametersFromAPort) {
  start(
      "  - {on: Cabin.Pressed, do: Lift.travel, name: Up, with: {height: Cabin.Wish, quickly: "
      "false}}\n"
      "  - Up.Done -> Lift.stop\n");
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 1; }));
  EXPECT_EQ(foreign->lift.height_, 2.5);
  EXPECT_EQ(foreign->lift.travels_, 1);
  EXPECT_EQ(text_of("Up", "Given"), "1");
}

TEST_F(ByInterfaceFile, ItsFailureIsToldAndBeginsTheNext) {
  start(
      "  - {on: Cabin.Pressed, do: Lift.travel, name: Up, with: {height: 1 m, quickly: true}}\n"
      "  - Up.Failed -> Lift.stop\n");
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 1; }));
  EXPECT_EQ(foreign->lift.travels_, 0);
  EXPECT_EQ(text_of("Up", "Failures"), "1");
  EXPECT_TRUE(until_logged("the rope is worn"));
}

TEST_F(ByInterfaceFile, SeveralOfACommandAreUnderWayInOrderAndTheEndOfEachIsTold) {
  start(
      "  - {on: Cabin.Pressed, do: Lift.enter, name: Enter, with: {weight: Cabin.Weight}}\n"
      "  - Enter.Done -> Lift.stop\n");
  cabin->press = 4;
  ASSERT_TRUE(until([&] { return text_of("Enter", "Given") == "4" && foreign->lift.waits_ == 1; }));
  EXPECT_EQ(text_of("Enter", "Refused"), "0");
  foreign->lift.open_the_door();
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 3; }));
  EXPECT_THAT(foreign->lift.entered(), ::testing::ElementsAre(80.0, 81.0, 82.0, 83.0));
  EXPECT_EQ(text_of("Enter", "Failures"), "1");
  EXPECT_TRUE(until_logged("it is full"));
}

TEST_F(ByInterfaceFile, OfACommandWithCancellationOneIsUnderWay) {
  start(
      "  - {on: Cabin.Pressed, do: Lift.enter, name: Enter, with: {weight: 1 kg}}\n"
      "  - {on: Cabin.Pressed, do: Lift.travel, name: Up, with: {height: 1 m, quickly: false}}\n");
  cabin->press = 2;
  EXPECT_TRUE(until([&] { return text_of("Up", "Refused") == "1"; }));
  EXPECT_TRUE(until_logged("this command does not queue from another process"));
  foreign->lift.open_the_door();
  EXPECT_TRUE(until([&] { return foreign->lift.travels_ == 1; }));
}

TEST_F(ByInterfaceFile, WhatIsOutOfItsRangeIsRefusedThere) {
  start(
      "  - {on: Cabin.Pressed, do: Lift.travel, name: Up, with: {height: 11 m, quickly: false}}\n"
      "  - Up.Failed -> Lift.stop\n");
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 1; }));
  EXPECT_EQ(foreign->lift.travels_, 0);
  EXPECT_TRUE(until_logged("parameter height is 11, expected 0 to 10"));
}

TEST_F(ByInterfaceFile, ItsPortsAreConnected) {
  start("  - Lift.Height -> Cabin.Height\n");
  EXPECT_TRUE(until([&] {
    static std::uint64_t sequence = 0;
    foreign->lift.raise(lift::Height{++sequence, 0, 7.5});
    return cabin->height == 7.5;
  }));
}

TEST_F(ByInterfaceFile, WhatIsWrittenToItsInputGoesThere) {
  start("  - Cabin.Weight -> Lift.Load\n");
  EXPECT_TRUE(until([&] { return foreign->lift.load_ == 80.0; }));
}

TEST_F(ByInterfaceFile, ToolsCallIt) {
  start("  []\n");
  using types::Value;
  ASSERT_TRUE(until([&] { return text_of("Lift", "PeerConnected") == "true"; }));
  const auto sum = call("add", {Value::of(std::int32_t{3}), Value::of(std::int32_t{4})});
  ASSERT_TRUE(sum) << sum.error();
  EXPECT_EQ(sum.value()->text(), "7");
  const auto& operations =
      component::interface_of(*application->application->find("Lift")).operations;
  const auto* const describe = operations.back();
  ASSERT_EQ(describe->name(), "describe");
  Value mode(*describe->signature().arguments[0].type);
  ASSERT_TRUE(types::from_text(mode.type(), "moving", mode.data()));
  const auto text = call("describe", {mode, Value::of(std::array<double, 2>{1, 9}),
                                      Value::of(std::vector<std::int32_t>{1, 2, 3})});
  ASSERT_TRUE(text) << text.error();
  EXPECT_EQ(text.value()->text(), "moving from 1 to 9, floors: 3");
  EXPECT_FALSE(call("travel", {}));
}

const std::string kAsk = R"(
  Ask:
    model: Request
    activity: {periodic: 2 ms}
    calls: {call: Lift.add, with: {a: 3, b: 4}}
connections:
  - Cabin.Pressed -> Ask.ask
)";

TEST_F(ByInterfaceFile, ARequestAsksItAndWritesWhatItAnswers) {
  foreign = std::make_unique<Foreign>();
  application = std::make_unique<Process>(components(foreign->at) + kAsk, add_models);
  application->start();
  cabin = &application->find<Cabin>("Cabin");
  EXPECT_TRUE(until([&] { return text_of("Lift", "PeerConnected") == "true"; }));
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return text_of("Ask", "Result") == "7"; }));
}

TEST_F(ByInterfaceFile, ASequenceCallsItInOrder) {
  foreign = std::make_unique<Foreign>();
  const std::string calls = R"(
  Sequence:
    model: Sequence
    activity: {periodic: 2 ms}
    calls:
      - {call: Lift.add, with: {a: 3, b: 4}}
      - {call: Lift.travel, with: {height: 250 cm, quickly: false}}
      - Lift.stop
connections:
  - Cabin.Pressed -> Sequence.run
)";
  application = std::make_unique<Process>(components(foreign->at) + calls, add_models);
  application->start();
  cabin = &application->find<Cabin>("Cabin");
  EXPECT_TRUE(until([&] { return text_of("Lift", "PeerConnected") == "true"; }));
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 1; }));
  EXPECT_EQ(foreign->lift.height_, 2.5);
}

TEST_F(ByInterfaceFile, NoRequestAsksItFromARealTimeThread) {
  std::string urgent = kAsk;
  urgent.replace(urgent.find("2 ms}"), 5, "2 ms, priority: 40}");
  EXPECT_THAT(mistakes(components("tcp://127.0.0.1:1") + urgent),
              ::testing::HasSubstr(
                  "'Ask' asks 'Lift.add' of another process from the real-time thread 'Ask'"));
}

TEST_F(ByInterfaceFile, ATextThatIsTooLongIsLeftOutAndCounted) {
  start("  - {on: Lift.Said, do: Cabin.come, name: Heard, with: {height: 1 m, quickly: false}}\n");
  EXPECT_TRUE(until([&] {
    foreign->lift.raise(lift::Said{std::string(128, 'x')});
    return text_of("Lift", "PeerMissed") != "0";
  }));
  EXPECT_EQ(text_of("Heard", "Given"), "0");
  EXPECT_TRUE(until_logged("sends 'Said' with a value that has no place here"));
  EXPECT_TRUE(until([&] {
    foreign->lift.raise(lift::Said{std::string(127, 'x')});
    return text_of("Heard", "Given") != "0";
  }));
}

/// The file says what may come; who sends may have another one, or none.
TEST_F(ByInterfaceFile, WhatComesOutOfItsRangeIsLeftOutAndCounted) {
  start("  - Lift.Height -> Cabin.Height\n");
  std::uint64_t sequence = 0;
  EXPECT_TRUE(until([&] {
    foreign->lift.raise(lift::Height{++sequence, 0, 101.0});
    return text_of("Lift", "PeerMissed") != "0";
  }));
  EXPECT_TRUE(until_logged("sends 'Height' with a value that has no place here"));
  EXPECT_EQ(cabin->height, 0.0);
  EXPECT_TRUE(until([&] {
    foreign->lift.raise(lift::Height{++sequence, 0, 100.0});
    return cabin->height == 100.0;
  }));
}

TEST_F(ByInterfaceFile, ItMayBeMissingAtTheStartAndDieAndComeBack) {
  const testing::KeptPort port;
  start(
      "  - {on: Cabin.Pressed, do: Lift.travel, name: Up, with: {height: 1 m, quickly: false}}\n"
      "  - Lift.Called -> Cabin.come\n",
      port.address());
  const auto state = [&] { return application->find<Placeholder>("Lift").state(); };
  EXPECT_TRUE(until([&] { return state() == State::kRunTimeError; }));
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return text_of("Up", "Refused") == "1"; }));
  for (int life = 1; life <= 2; ++life) {
    foreign = std::make_unique<Foreign>(port.address());
    EXPECT_TRUE(until([&] { return state() == State::kRunning; }));
    cabin->press = 1;
    EXPECT_TRUE(until([&] { return foreign->lift.travels_ == 1; }));
    EXPECT_TRUE(until([&] {
      foreign->lift.raise(lift::Called{double(life), false});
      return cabin->came == double(life);
    }));
    foreign.reset();
    EXPECT_TRUE(until([&] { return state() == State::kRunTimeError; }));
  }
  EXPECT_EQ(text_of("Lift", "PeerLosses"), "2");
}

/// The same name and another interface is refused; another definition of the same one is told.
TEST_F(ByInterfaceFile, AComponentWithAnotherInterfaceIsNotUsed) {
  foreign = std::make_unique<Foreign>();
  application = std::make_unique<Process>(components(foreign->at, kFile + "#Door"), add_models);
  application->start();
  EXPECT_TRUE(until_logged("no component of this name has the interface 'Door'"));
  EXPECT_EQ(text_of("Lift", "PeerConnected"), "false");
}

TEST_F(ByInterfaceFile, AnotherDefinitionOfItsInterfaceIsToldAndUsedAsFarAsItIsTheSame) {
  const std::string file = ::testing::TempDir() + "another_lift.idl";
  std::ofstream(file) << "interface Lift { void stop(); void fly(); };";
  foreign = std::make_unique<Foreign>();
  application = std::make_unique<Process>(
      components(foreign->at, file) +
          "connections:\n  - {on: Cabin.Pressed, do: Lift.fly, name: Up}\n"
          "  - Up.Failed -> Lift.stop\n",
      add_models);
  application->start();
  cabin = &application->find<Cabin>("Cabin");
  EXPECT_TRUE(until_logged("has another definition of Lift"));
  cabin->press = 1;
  EXPECT_TRUE(until([&] { return foreign->lift.stops_ == 1; }));
  EXPECT_TRUE(until_logged("has no operation of this number"));
  std::remove(file.c_str());
}

TEST_F(ByInterfaceFile, MistakesAreToldWithTheirPlaces) {
  const std::string remote = "{remote: 'tcp://127.0.0.1:4242/Lift', ";
  const std::string text = mistakes(
      "components:\n  A: " + remote + "interface: no.idl}\n  B: " + remote + "interface: '" +
      kFile + "', model: Axis}\n  C: {interface: '" + kFile + "'}\n  D: " + remote +
      "interface: '" + kFile + "', properties: {Speed: 1}}\n  E: " + remote + "interface: '" +
      kFile + "', activity: {periodic: 1 ms}}\n");
  EXPECT_THAT(text, HasSubstr("test.yaml:2:"));
  EXPECT_THAT(text, HasSubstr("'A', interface: file 'no.idl' does not exist"));
  EXPECT_THAT(text, HasSubstr("component 'B': it has a model and an interface"));
  EXPECT_THAT(text, HasSubstr("component 'C': it has an interface, which describes a component of "
                              "another process (say where it is: remote: tcp://host:port/Name)"));
}

TEST_F(ByInterfaceFile, ItHasNoPropertiesAndNoActivityHere) {
  const std::string remote = "{remote: 'tcp://127.0.0.1:4242/Lift', interface: '" + kFile + "', ";
  const std::string text =
      mistakes("components:\n  A: " + remote + "properties: {Speed: 1}}\n  B: " + remote +
               "activity: {periodic: 1 ms}}\n");
  EXPECT_THAT(text, HasSubstr("'A' (Lift) has no property 'Speed'"));
  EXPECT_THAT(text, HasSubstr("'B' lives in another process, which has its activity"));
}

TEST_F(ByInterfaceFile, ConnectionsAreChecked) {
  const std::string text = mistakes(components("tcp://127.0.0.1:4242") +
                                    "connections:\n  - Cabin.Pressed -> Lift.travell\n"
                                    "  - Cabin.Pressed -> Lift.add\n"
                                    "  - Lift.Sayd -> Cabin.come\n"
                                    "  - Lift.Changed -> Cabin.come\n"
                                    "  - Cabin.Wish -> Lift.Load\n");
  EXPECT_THAT(text, HasSubstr("'Lift' has no command 'travell' (did you mean 'travel'?)"));
  EXPECT_THAT(text, HasSubstr("'Lift.add' is an operation, whose end nobody is told"));
  EXPECT_THAT(text, HasSubstr("'Lift' has no output port 'Sayd'"));
  EXPECT_THAT(text, HasSubstr("'mode' of 'Lift.Changed' is Mode"));
  EXPECT_THAT(text, HasSubstr("'Cabin.Wish' is in 'm', but 'Lift.Load' expects 'kg'"));
}

TEST_F(ByInterfaceFile, CppCallsItByItsOwnTypes) {
  foreign = std::make_unique<Foreign>();
  for (const char* activity : {", activity: {periodic: 2 ms}", ""}) {
    application = std::make_unique<Process>(
        components(foreign->at) + "  Caller: {model: Caller, peers: [Lift]" + activity + "}\n",
        add_models);
    application->start();
    auto& caller = application->find<Caller>("Caller");
    EXPECT_TRUE(until([&] {
      foreign->lift.raise(lift::Called{1.0, true});
      return caller.called == 42;
    }));
    if (*activity != '\0') EXPECT_TRUE(until([&] { return caller.sum == 7; }));
  }
}

TEST_F(ByInterfaceFile, CppWithOtherTypesIsRefused) {
  EXPECT_THAT(
      mistakes("components:\n  Lift: {remote: 'tcp://127.0.0.1:4242/Lift', interface: '" + kFile +
               "'}\n  There: {model: Other, peers: [Lift], activity: {periodic: 5 ms}}\n"),
      HasSubstr("'Lift.add' is int32(int32 a, int32 b)"));
}

}  // namespace
}  // namespace armature::remote
