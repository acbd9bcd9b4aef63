// SPDX-License-Identifier: Apache-2.0
// Sequences of calls that a deployment names, in one thread and between two.
#include <chrono>
#include <memory>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/general/controls/sequence.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::general {
namespace {

using component::ExecutionContext;
using component::Host;

class Served final : public component::Component {
 public:
  using Component::Component;
  int asked = 0;
  int moved = 0;
  bool goes_on = false;
  component::OutputPort<std::vector<double>> places{this, "Places", "", "",
                                                    component::fixed_size(7)};
  component::Operation<bool(const std::vector<double>&)> ask{
      this, "ask", component::serve<&Served::answer>, "", component::args("places")};
  component::Command<> move{this, "move", component::serve<&Served::begin>, ""};

 private:
  bool answer(const std::vector<double>&) {
    ++asked;
    return true;
  }
  component::Outcome begin() {
    ++moved;
    if (!goes_on) move.complete();
    return component::accepted();
  }
};

class CallFunctions : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    std::vector<component::NamedCall> calls(2);
    calls[0] = {"Call1", "served.ask", &face(served_.ask),
                std::vector<component::CallParameter>(1)};
    calls[0].parameters[0].from = component::CallParameter::From::kPort;
    calls[0].parameters[0].input = "places";
    calls[0].parameters[0].port = &face(served_.places);
    calls[1] = {"Call2", "served.move", &face(served_.move), {}};
    ASSERT_TRUE(sequence_.declare_calls(std::move(calls)));
    Host::assign_context(sequence_, here_);
    Host::assign_context(served_, GetParam() ? here_ : there_);
    for (component::Component* each : all()) ASSERT_TRUE(Host::configure(*each));
    const component::Interface& interface = component::interface_of(sequence_);
    face(served_.places).prepare();
    face(served_.places).connect(*interface.inputs.front(), {});
    interface.callers[0]->connect(face(served_.ask));
    interface.callers[1]->connect(face(served_.move));
    for (component::Component* each : all()) ASSERT_TRUE(Host::activate(*each));
    for (component::Component* each : all()) ASSERT_TRUE(Host::start(*each));
    served_.places.write(std::vector<double>(7, 1.0));
  }
  void TearDown() override {
    deliver();
    for (auto* caller : component::interface_of(sequence_).callers) caller->disconnect();
    face(served_.places).disconnect_all();
  }
  std::vector<component::Component*> all() { return {&served_, &sequence_}; }
  component::CommandBase& run() {
    return static_cast<component::CommandBase&>(
        *component::interface_of(sequence_).operations.front());
  }
  void deliver() {
    for (int round = 0; round < 4; ++round) {
      for (ExecutionContext* context : {&here_, &there_}) {
        ++context->cycle;
        context->cycle_time = context->cycle_time.load() + std::chrono::milliseconds(1);
        context->inbox.deliver_all();
      }
    }
  }

  ExecutionContext here_{"here"};
  ExecutionContext there_{"there"};
  Served served_{"served"};
  Sequence sequence_{"sequence"};
};

TEST_P(CallFunctions, ASequenceCallsOneAfterTheOther) {
  const auto sequence = [&] {
    static_cast<void>(run().begin_from(nullptr, nullptr));
    deliver();
  };
  expect_realtime("UntypedOperationCaller::send", sequence);
  expect_realtime("CallParameters::collect", sequence);
  expect_realtime("NamedCall::begin", sequence);
  EXPECT_EQ(served_.asked, 303);
  EXPECT_EQ(served_.moved, 303);
}

TEST_P(CallFunctions, ASequenceIsCancelled) {
  served_.goes_on = true;
  const auto cancelled = [&] {
    static_cast<void>(run().begin_from(nullptr, nullptr));
    deliver();
    Host::stop(sequence_);
    deliver();
    static_cast<void>(Host::start(sequence_));
  };
  expect_realtime("UntypedOperationCaller::forget", cancelled);
  expect_realtime("NamedCall::call_off", cancelled);
  EXPECT_EQ(served_.moved, 202) << "each was cancelled, else the next would be refused";
}

INSTANTIATE_TEST_SUITE_P(Each, CallFunctions, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "OneThread" : "TwoThreads"; });

}  // namespace
}  // namespace armature::general
