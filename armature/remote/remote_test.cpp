// SPDX-License-Identifier: Apache-2.0
// Two applications, each as a deployment has it: the components of one are used by the other.
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/link_to.hpp"
#include "armature/remote/network.hpp"
#include "armature/remote/placeholder.hpp"
#include "armature/remote/value_codec.hpp"
#include "armature/ride/node.hpp"

extern "C" armature::remote::Network* armature_make_network(
    const armature::remote::NetworkOptions& options);

namespace armature::remote {
namespace {

using component::accepted;
using component::Component;
using component::Outcome;
using component::serve;
using component::State;
using std::chrono_literals::operator""s;
using testing::HasSubstr;

/// The one that lives in the other process.
class Axis final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    position_.write(position_.last() + 1.0);
    if (static_cast<int>(position_.last()) % 10 == 0) tenth_.raise(int(position_.last()), 0.5);
    if (left_ > 0) travel_.report(1.0 - 0.1 * --left_);
  }
  double twice(double x) { return 2.0 * x; }
  void arm() { ++armed_; }
  int armed() { return armed_; }
  int fail(int) { throw std::runtime_error("it broke"); }
  Outcome begin_travel(double target) {
    if (target > 3.0) return component::refused("the target is outside the shaft");
    left_ = target > 2.0 ? 1'000'000 : 10;
    return accepted();
  }
  bool arrived() { return left_ == 0; }
  void halt() { left_ = 0; }
  void take(double wish) { taken_.write(wish); }

  component::OutputPort<double> position_{this, "Position", ""};
  component::OutputPort<double> taken_{this, "Taken", "what came to Wish"};
  component::InputPort<double> wish_{
      this, "Wish", "", "", component::on_data<&Axis::take>, component::may_stay_open};
  component::InputPort<double> closed_{this, "Closed", "", "", component::may_stay_open};
  component::Event<int, double> tenth_{this, "Tenth", ""};
  component::Operation<double(double)> twice_{this, "twice", serve<&Axis::twice>, ""};
  component::Operation<void()> arm_{this, "arm", serve<&Axis::arm>, "", component::by_operator};
  component::Operation<int()> get_armed_{this, "armed", serve<&Axis::armed>, ""};
  component::Operation<int(int)> fail_{this, "fail", serve<&Axis::fail>, ""};
  component::Command<double> travel_{this,
                                     "travel",
                                     serve<&Axis::begin_travel>,
                                     "",
                                     component::done_when<&Axis::arrived>,
                                     component::cancelled_by<&Axis::halt>};
  int left_ = 0;
  int armed_ = 0;
};

/// The one that uses it. Its members are looked at by the test, so they are atomic.
class User final : public Component {
 public:
  using Component::Component;

  std::atomic<double> position{0.0};
  std::atomic<int> tenths{0};
  std::atomic<int> lost{0};
  std::atomic<double> answer{0.0};
  std::atomic<component::CallStatus> status{component::CallStatus::kPending};
  std::atomic<double> target{0.0};  ///< a travel is begun once it is above 0
  std::atomic<bool> cancel{false};
  std::atomic<component::CommandStage> stage{component::CommandStage::kFree};
  std::atomic<double> progress{0.0};
  std::atomic<double> wish{0.0};
  std::atomic<int> updates{0};
  std::atomic<int> timeouts{0};

 private:
  void on_update() override {
    const auto result = twice_(4.0);
    status = result.status;
    if (result.status == component::CallStatus::kTimeout) ++timeouts;
    ++updates;
    answer = result.value;
    if (target > 0.0) travel_ = caller_.send(target.exchange(0.0));
    if (cancel.exchange(false)) travel_.cancel();
    stage = travel_.stage();
    progress = travel_.progress();
    if (wish != 0.0) wish_.write(wish);
  }
  void note(double value) { position = value; }
  void count(int, double) { ++tenths; }
  void count_loss() { ++lost; }

  component::InputPort<double> position_{this,
                                         "Position",
                                         "",
                                         "",
                                         component::on_data<&User::note>,
                                         component::on_lost(component::Reaction::kHold)};
  component::OutputPort<double> wish_{this, "Wish", ""};
  component::EventHandler<int, double> tenth_{this, "Tenth", serve<&User::count>, "",
                                              component::optional};
  component::EventHandler<> peer_lost_{this, "PeerLost", serve<&User::count_loss>, "",
                                       component::optional};
  component::OperationCaller<double(double)> twice_{this, "twice", "", component::optional};
  component::CommandCaller<double> caller_{this, "travel", "", component::optional};
  component::CommandHandle travel_{component::CallStatus::kNotConnected};
};

/// A process: its network and its application.
class Process {
 public:
  explicit Process(const std::string& yaml) {
    NetworkOptions options;
    options.log = [this](const rt::LogRecord& record) { log += record.message() + "\n"; };
    network_.reset(armature_make_network(options));
    deploy::DeploymentOptions how;
    how.models = [](component::Registry& models) {
      models.add<Axis>("Axis", "");
      models.add<User>("User", "");
    };
    how.make_placeholder = [this](const deploy::Component& written,
                                  std::unique_ptr<Component> prototype) {
      return network_->make_placeholder(written, std::move(prototype));
    };
    how.make_inlets = [this](const std::vector<component::InputPortBase*>& inputs) {
      return base::Result(network_->make_inlets(inputs));
    };
    deployment = deploy::parse_deployment(yaml, "test.yaml", how);
  }
  ~Process() {
    network_->leave();
    if (application != nullptr) application->stop();
    application.reset();
  }

  void start() {
    ASSERT_EQ(deployment.diagnostics.to_text(), "");
    exec::ApplicationOptions options = deployment.options;
    options.log = [this](const rt::LogRecord& record) { log += record.message() + "\n"; };
    application = std::make_unique<exec::Application>(std::move(deployment.blueprint), options);
    base::Diagnostics diagnostics;
    network_->open(deployment.document, {}, *application, diagnostics);
    ASSERT_EQ(diagnostics.to_text(), "");
    diagnostics.append(application->start());
    ASSERT_EQ(diagnostics.to_text(), "");
  }
  void serve() {
    network_->serve();
    application->drain_logs();
  }
  std::string address() const { return network_->addresses().front(); }
  template <typename T>
  T& find(std::string_view name) const {
    return dynamic_cast<T&>(*application->find(name));
  }

  deploy::Deployment deployment;
  std::string log;
  std::unique_ptr<Network> network_;
  std::unique_ptr<exec::Application> application;
};

std::string server(const std::string& listen = "tcp://127.0.0.1:0", const std::string& more = {}) {
  return "network: {listen: '" + listen + "', policy: " + REMOTE_TESTDATA + "/all.policy" + more +
         "}\ncomponents: {Axis: {model: Axis, activity: {periodic: 2 ms}}}\n";
}

std::string client(const std::string& address, const std::string& more = {}) {
  return "components:\n  There: {model: Axis, remote: '" + address +
         "/Axis'}\n  User: {model: User, activity: {periodic: 5 ms}, peers: [There]}\n"
         "connections: [There.Position -> User.Position" +
         more + "]\n";
}

/// Serves until `condition`; the limit is for a test that would hang.
bool serve_until(const std::vector<Process*>& all, const std::function<bool()>& condition) {
  const base::Time end = platform::monotonic_now() + 30s;
  while (!condition()) {
    if (platform::monotonic_now() > end) return false;
    for (Process* const one : all) one->serve();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

struct Remote : testing::Test {
  void start() {
    robot = std::make_unique<Process>(server());
    robot->start();
    pilot = std::make_unique<Process>(client(robot->address()));
    start_pilot();
  }
  /// Its start asks for what the robot's controlling thread answers.
  void start_pilot() {
    pilot->start();
    user = &pilot->find<User>("User");
  }
  bool until(const std::function<bool()>& condition) {
    std::vector<Process*> all{pilot.get()};
    if (robot != nullptr) all.push_back(robot.get());
    return serve_until(all, condition);
  }
  Placeholder& there() const { return pilot->find<Placeholder>("There"); }

  std::unique_ptr<Process> robot;
  std::unique_ptr<Process> pilot;
  User* user = nullptr;
};

TEST_F(Remote, PortsEventsAndOperationsAreUsedAsIfTheyWereHere) {
  start();
  EXPECT_TRUE(until([&] { return user->position > 20.0 && user->tenths > 2; }));
  EXPECT_TRUE(until([&] { return user->answer == 8.0; }));
  EXPECT_EQ(user->status, component::CallStatus::kDone);
  EXPECT_EQ(there().state(), State::kRunning);
}

TEST_F(Remote, ACommandIsFollowedToItsEnd) {
  start();
  user->target = 1.0;
  EXPECT_TRUE(until([&] { return user->progress > 0.2; }));
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kDone; }));
  user->target = 5.0;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kFailed; }));
}

TEST_F(Remote, ACommandThatIsCancelledHereEndsThere) {
  start();
  user->target = 2.5;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kAccepted; }));
  user->cancel = true;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kCancelled; }));
  user->target = 1.0;  // it could not begin if the one before were under way there
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kDone; }));
}

/// While nobody subscribes nothing is attached, so that others cost a real-time thread nothing.
TEST_F(Remote, WhatNobodyUsesElsewhereIsNotListenedTo) {
  robot = std::make_unique<Process>(server());
  robot->start();
  const auto& position = *robot->find<Axis>("Axis").interface().outputs.front();
  EXPECT_FALSE(position.is_tapped());
  pilot = std::make_unique<Process>(client(robot->address()));
  start_pilot();
  EXPECT_TRUE(until([&] { return user->position > 1.0; }));
  EXPECT_TRUE(position.is_tapped());
  pilot.reset();
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return !position.is_tapped(); }));
}

TEST_F(Remote, ALostPeerIsToldAndComesBackByItself) {
  start();
  EXPECT_TRUE(until([&] { return user->position > 5.0; }));
  const std::string address = robot->address();
  robot.reset();
  EXPECT_TRUE(until([&] { return there().state() == State::kRunTimeError; }));
  EXPECT_TRUE(until([&] { return user->lost == 1; }));
  EXPECT_TRUE(until([&] { return user->status == component::CallStatus::kUnreachable; }));
  EXPECT_TRUE(until([&] {
    return pilot->log.find("'Axis' at " + address + " cannot be used") != std::string::npos;
  }));
  robot = std::make_unique<Process>(server(address));
  robot->start();
  user->position = 0.0;
  EXPECT_TRUE(until([&] { return there().state() == State::kRunning; }));
  EXPECT_TRUE(until([&] { return user->position > 0.0; }));
  EXPECT_TRUE(until([&] { return user->status == component::CallStatus::kDone; }));
  EXPECT_EQ(user->lost, 1);
}

TEST_F(Remote, ACommandUnderWayFailsWithTheConnection) {
  start();
  user->target = 2.5;
  EXPECT_TRUE(until([&] { return user->stage == component::CommandStage::kAccepted; }));
  robot.reset();
  EXPECT_TRUE(until([&] { return user->stage >= component::CommandStage::kRefused; }));
  EXPECT_NE(user->stage, component::CommandStage::kDone);
}

TEST_F(Remote, APilotMayStartBeforeTheRobot) {
  const auto free = std::make_unique<Process>(server());
  free->start();
  const std::string address = free->address();
  free->~Process();
  new (free.get()) Process(server(address));
  pilot = std::make_unique<Process>(client(address));
  start_pilot();
  EXPECT_TRUE(until([&] { return there().state() == State::kRunTimeError; }));
  EXPECT_EQ(user->position, 0.0);
  free->start();
  EXPECT_TRUE(serve_until({pilot.get(), free.get()}, [&] { return user->position > 0.0; }));
}

TEST_F(Remote, OnlyInputsThatTheDeploymentOpensAreWrittenFromElsewhere) {
  robot = std::make_unique<Process>(
      server("tcp://127.0.0.1:0", ", inputs: [{to: Axis.Wish, max_age: 10 s}]"));
  robot->start();
  pilot = std::make_unique<Process>(
      client(robot->address(), ", User.Wish -> There.Wish, User.Wish -> There.Closed"));
  start_pilot();
  user->wish = 0.75;
  const auto& axis = robot->find<Axis>("Axis");
  const auto taken = [&] {
    return *robot->application->value_of("Axis", "Taken").value().get_if<double>();
  };
  EXPECT_TRUE(until([&] { return taken() == 0.75; }));
  EXPECT_EQ(*robot->application->value_of("Axis", "Closed").value().get_if<double>(), 0.0);
  EXPECT_EQ(axis.state(), State::kRunning);
}

TEST_F(Remote, DataOfAPeerThatIsGoneIsTooOldSoon) {
  robot = std::make_unique<Process>(
      server("tcp://127.0.0.1:0", ", inputs: [{to: Axis.Wish, max_age: 2 s}]"));
  robot->start();
  pilot = std::make_unique<Process>(client(robot->address(), ", User.Wish -> There.Wish"));
  start_pilot();
  user->wish = 0.75;
  const auto& axis = robot->find<Axis>("Axis");
  EXPECT_TRUE(until([&] {
    return *robot->application->value_of("Axis", "Taken").value().get_if<double>() == 0.75;
  }));
  EXPECT_EQ(axis.state(), State::kRunning);
  pilot.reset();
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return axis.state() == State::kStopped; }));
}

/// The robot's controlling thread does nothing here: whoever waits for an answer waits in vain.
TEST_F(Remote, APeerThatDoesNotAnswerHoldsUpNoRealTimeThread) {
  robot = std::make_unique<Process>(server());
  robot->start();
  pilot = std::make_unique<Process>(R"(components:
  There: {model: Axis, remote: ')" + robot->address() +
                                    R"(/Axis'}
  Patient: {model: User, activity: {periodic: 5 ms}, peers: [There]}
  Quick: {model: User, activity: {periodic: 1 ms, priority: 10}, peers: [There]}
connections: [There.Position -> Patient.Position, There.Position -> Quick.Position,
              Quick.Wish -> There.Wish]
)");
  pilot->start();
  const User& patient = pilot->find<User>("Patient");
  User& quick = pilot->find<User>("Quick");
  quick.wish = 1.0;
  EXPECT_TRUE(serve_until({pilot.get()}, [&] { return patient.timeouts == 1; }));
  const int before = quick.updates;
  EXPECT_TRUE(serve_until({pilot.get()}, [&] { return patient.timeouts == 2; }));
  EXPECT_GT(quick.updates - before, 100);  // a second is a thousand of its cycles
  EXPECT_EQ(quick.status, component::CallStatus::kWouldWait);
  EXPECT_EQ(quick.timeouts, 0);
}

// --- what a peer that is no application of ours gets
// ----------------------------------------------

struct Peer {
  explicit Peer(const std::string& address, const ride::Interface& interface)
      : link(node.connect(address), "Axis", interface) {}
  /// The answer to a request while `robot` serves.
  ride::Code ask(Process& robot, ride::Number number, const ride::Fields& fields,
                 std::string* text = nullptr) {
    struct Answer {
      std::atomic<bool> came{false};
      ride::Code code{};
      std::string text;
    };
    const auto answer = std::make_shared<Answer>();
    link.ask(number, fields, [answer](ride::Code code, std::string_view why, auto) {
      answer->code = code;
      answer->text = why;
      answer->came = true;
    });
    EXPECT_TRUE(serve_until({&robot}, [&] { return answer->came.load(); }));
    if (text != nullptr) *text = answer->text;
    return answer->code;
  }
  ride::Node node;
  LinkTo link;
};

struct RemotePeer : testing::Test {
  void start(const std::string& yaml) {
    robot = std::make_unique<Process>(yaml);
    robot->start();
    peer = std::make_unique<Peer>(robot->address(), numbers.interface());
    ASSERT_TRUE(peer->link.peer().wait_until_connected(10s));
  }
  const Axis axis{"Axis"};
  const InterfaceNumbers numbers{"Axis", axis.interface()};
  std::unique_ptr<Process> robot;
  std::unique_ptr<Peer> peer;
  const std::tuple<> nothing;
};

TEST_F(RemotePeer, AnActOfTheOperatorNeedsAGrant) {
  start(server());
  std::string text;
  EXPECT_EQ(peer->ask(*robot, ride::number_of("void arm()"), ride::Fields(nothing), &text),
            ride::Code::kFailed);
  EXPECT_THAT(text, HasSubstr("grants: {remote: [Axis.arm]}"));
  EXPECT_EQ(*robot->application->call("Axis", "armed", {}).value()->get_if<int>(), 0);
  peer.reset();
  start(server() + "grants: {remote: [Axis.arm]}\n");
  EXPECT_EQ(peer->ask(*robot, ride::number_of("void arm()"), ride::Fields(nothing)),
            ride::Code::kNone);
  EXPECT_EQ(*robot->application->call("Axis", "armed", {}).value()->get_if<int>(), 1);
}

TEST_F(RemotePeer, WithoutAPolicyNothingButLookingIsAllowed) {
  start(
      "network: {listen: 'tcp://127.0.0.1:0'}\n"
      "components: {Axis: {model: Axis, activity: {periodic: 2 ms}}}\n");
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int armed()"), ride::Fields(nothing)),
            ride::Code::kNotAllowed);
  std::atomic<int> samples{0};
  const ride::Subscription subscription =
      peer->link.subscribe(numbers.number(Member::Kind::kOutput, 0), [&](ride::Decoder&) {
        ++samples;
        return true;
      });
  EXPECT_TRUE(serve_until({robot.get()}, [&] { return samples > 3; }));
}

TEST_F(RemotePeer, WhatFailsThereIsToldHere) {
  start(server());
  std::string text;
  const std::tuple one{1};
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fail(int)"), ride::Fields(one), &text),
            ride::Code::kFailed);
  EXPECT_THAT(text, HasSubstr("it broke"));
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fail(int)"), ride::Fields(nothing)),
            ride::Code::kMalformed);
  EXPECT_EQ(peer->ask(*robot, ride::number_of("int fell(int)"), ride::Fields(one)),
            ride::Code::kNoSuchOperation);
}

/// Each gap in what a port wrote can be seen from the sequence.
TEST_F(RemotePeer, SamplesComeInTheirOrderWithTheirNumber) {
  start(server());
  std::mutex mutex;
  std::vector<std::pair<std::uint64_t, double>> samples;
  const ride::Subscription subscription =
      peer->link.subscribe(numbers.number(Member::Kind::kOutput, 0), [&](ride::Decoder& members) {
        std::uint64_t sequence = 0;
        std::int64_t time = 0;
        double value = 0.0;
        if (!members.take(sequence) || !members.take(time) || !members.take(value)) return false;
        const std::lock_guard lock(mutex);
        samples.emplace_back(sequence, value);
        return members.ended();
      });
  EXPECT_TRUE(serve_until({robot.get()}, [&] {
    const std::lock_guard lock(mutex);
    return samples.size() > 20;
  }));
  const std::lock_guard lock(mutex);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(static_cast<double>(samples[i].first), samples[i].second);  // it counts its writes
    if (i > 0) {
      EXPECT_GE(samples[i].first, samples[i - 1].first);
    }
  }
}

// --- what a deployment may say -------------------------------------------------------------------

TEST(RemoteDeployment, MistakesAreToldWithTheirPlaces) {
  const Process wrong(R"(network: {inputs: [Axis.Wish, Axis.Wich, Axes.Wish]}
components:
  Axis: {model: Axis, activity: {periodic: 2 ms}}
  A: {model: Axis, remote: tcp://127.0.0.1:4242}
  B: {model: Axis, remote: tcp://127.0.0.1:4242/Axis, activity: {periodic: 2 ms}}
  C: {model: Axis, remote: ftp/Axis}
)");
  const std::string text = wrong.deployment.diagnostics.to_text();
  EXPECT_THAT(text,
              HasSubstr("test.yaml:4:28: error: 'A', remote: 'tcp://127.0.0.1:4242' must be"));
  EXPECT_THAT(text, HasSubstr("'B' lives in another process: its activity is there"));
  EXPECT_THAT(text, HasSubstr("test.yaml:6:28: error: 'C', remote: "));
  EXPECT_THAT(text, HasSubstr("'Axis' has no input 'Wich'"));
  EXPECT_THAT(text, HasSubstr("did you mean 'Wish'?"));
  EXPECT_THAT(text, HasSubstr("there is no component 'Axes'"));
  EXPECT_THAT(text, HasSubstr("max_age: 100 ms"));
}

TEST(RemoteDeployment, AddressesAndPolicyAreCheckedBeforeAnythingListens) {
  const Process wrong(R"(network: {listen: [tcp://127.0.0.1:0, "tcp:nowhere"], policy: no.policy}
components: {Axis: {model: Axis, activity: {periodic: 2 ms}}}
)");
  base::Diagnostics diagnostics = wrong.deployment.diagnostics;
  wrong.network_->check(wrong.deployment.document, diagnostics);
  const std::string text = diagnostics.to_text();
  EXPECT_THAT(text, HasSubstr("test.yaml:1:39: error: "));
  EXPECT_THAT(text, HasSubstr("tcp:nowhere"));
  EXPECT_THAT(text, HasSubstr("no.policy"));
  EXPECT_TRUE(wrong.network_->addresses().empty());
}

}  // namespace
}  // namespace armature::remote
