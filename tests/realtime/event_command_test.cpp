// SPDX-License-Identifier: Apache-2.0
// Events that command, in one thread and between two.
#include "armature/exec/event_command.hpp"

#include <memory>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/types/elements.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::exec {
namespace {

using component::ExecutionContext;
using component::Host;

class Raiser final : public component::Component {
 public:
  using Component::Component;
  component::Event<double> raised{this, "Raised", "", {"number"}};
  component::OutputPort<std::vector<double>> vector{this, "Vector", "", "",
                                                    component::fixed_size(7)};
};

class Server final : public component::Component {
 public:
  using Component::Component;
  int begun = 0;
  component::Command<double, const std::vector<double>&> move{
      this, "move", component::serve<&Server::begin>, "", component::args("number", "places")};

 private:
  component::Outcome begin(double number, const std::vector<double>&) {
    ++begun;
    if (number < 0.0) return component::refused("no");
    move.complete();
    return component::accepted();
  }
};

class EventCommandFunctions : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    std::vector<component::CallParameter> parameters(2);
    parameters[1].from = component::CallParameter::From::kPort;
    parameters[1].input = "places";
    parameters[1].port = &face(raiser_.vector);
    wire_ = std::make_unique<EventCommand>("wire", face(raiser_.raised), face(server_.move),
                                           std::move(parameters), std::chrono::seconds(1));
    Host::assign_context(raiser_, here_);
    Host::assign_context(*wire_, here_);
    Host::assign_context(server_, GetParam() ? here_ : there_);
    const component::Interface& interface = component::interface_of(*wire_);
    for (component::Component* each : all()) ASSERT_TRUE(Host::configure(*each));
    face(raiser_.vector).prepare();
    face(raiser_.vector).connect(*interface.inputs.front(), {});
    face(raiser_.raised).subscribe(*interface.handlers.front());
    interface.callers.front()->connect(face(server_.move));
    for (component::Component* each : all()) ASSERT_TRUE(Host::activate(*each));
    for (component::Component* each : all()) ASSERT_TRUE(Host::start(*each));
  }
  void TearDown() override {
    deliver();
    face(raiser_.raised).unsubscribe_all();
    component::interface_of(*wire_).callers.front()->disconnect();
    face(raiser_.vector).disconnect_all();
  }
  std::vector<component::Component*> all() { return {&raiser_, wire_.get(), &server_}; }
  void deliver() {
    for (int round = 0; round < 2; ++round) {
      for (ExecutionContext* context : {&here_, &there_}) {
        ++context->cycle;
        context->cycle_time = context->cycle_time.load() + std::chrono::milliseconds(1);
        context->inbox.deliver_all();
      }
    }
  }
  /// What one of its attributes says.
  std::string told(const std::string& name) const {
    for (const auto* property : component::interface_of(*wire_).properties) {
      if (property->name() == name) return types::Value(property->type(), property->data()).text();
    }
    return "no " + name;
  }

  ExecutionContext here_{"here"};
  ExecutionContext there_{"there"};
  Raiser raiser_{"raiser"};
  Server server_{"server"};
  std::unique_ptr<EventCommand> wire_;
};

TEST_P(EventCommandFunctions, AnEventGivesACommandAndIsToldItsEnd) {
  const std::vector<double> places(7, 1.0);
  expect_realtime("UntypedCommandCaller::send", [&] {
    raiser_.vector.write(places);
    raiser_.raised.raise(1.0);
    deliver();
  });
  EXPECT_EQ(server_.begun, 101);
  EXPECT_EQ(told("Given"), "101");
  EXPECT_EQ(told("Refused"), "0");
}

TEST_P(EventCommandFunctions, RefusalsAreCounted) {
  raiser_.vector.write(std::vector<double>(7, 1.0));
  expect_realtime("UntypedInputPort::read", [&] {
    raiser_.raised.raise(-1.0);
    deliver();
  });
  EXPECT_EQ(told("Refused"), "101");
}

TEST_P(EventCommandFunctions, SoManyMayBeUnderWay) {
  raiser_.vector.write(std::vector<double>(7, 1.0));
  expect_realtime("EventCommand", [&] {
    for (std::size_t i = 0; i <= EventCommand::kMost; ++i) raiser_.raised.raise(1.0);
    deliver();
  });
  EXPECT_EQ(told("Given"), std::to_string(101 * EventCommand::kMost));
  EXPECT_EQ(told("Refused"), "101");
}

TEST_P(EventCommandFunctions, ItIsStoppedAndStartedAsAModeDoesIt) {
  raiser_.vector.write(std::vector<double>(7, 1.0));
  bool started = true;
  const auto again = [&] {
    raiser_.raised.raise(1.0);
    Host::stop(*wire_);
    deliver();
    started = Host::start(*wire_) && started;
  };
  expect_realtime("UntypedCommandCaller::forget", again);
  expect_realtime("UntypedCommandCaller::resume", again);
  EXPECT_TRUE(started);
  EXPECT_EQ(told("Given"), "202");
}

INSTANTIATE_TEST_SUITE_P(Each, EventCommandFunctions, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "OneThread" : "TwoThreads"; });

TEST(EventCommandNumbers, ANumberBecomesTheParameters) {
  const std::int32_t pixels = 160;
  double parameter = 0.0;
  const types::Type& from = types::type_of<std::int32_t>();
  const types::Type& to = types::type_of<double>();
  expect_realtime("types::convert_number",
                  [&] { types::convert_number(from, &pixels, to, &parameter); });
  EXPECT_EQ(parameter, 160.0);
}

}  // namespace
}  // namespace armature::exec
