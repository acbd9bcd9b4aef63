// SPDX-License-Identifier: Apache-2.0
// Ports, for every way in which reader and writer may be connected.
#include <array>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/rt/inbox.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::component {
namespace {

using std::chrono::milliseconds;

class Source final : public Component {
 public:
  using Component::Component;
  OutputPort<double> number{this, "Number", ""};
  OutputPort<std::vector<double>> vector{this, "Vector", "", "", fixed_size(7)};
};

class Sink final : public Component {
 public:
  using Component::Component;

  int handled = 0;
  InputPort<double> number{this, "Number", ""};
  InputPort<std::vector<double>> vector{this, "Vector", "", "", fixed_size(7)};
  InputPort<double> triggering{this, "Triggering", "", "", on_data<&Sink::handle>};

 private:
  void handle(double) { ++handled; }
};

struct Connection {
  std::string name;
  ConnectionPolicy policy;
  bool same_thread;
};

std::vector<Connection> connections() {
  ConnectionPolicy latest;
  ConnectionPolicy refusing{ConnectionPolicy::Kind::kFifo, 4, rt::WhenFull::kDropNewest, false};
  ConnectionPolicy dropping{ConnectionPolicy::Kind::kFifo, 4, rt::WhenFull::kDropOldest, false};
  ConnectionPolicy delayed;
  delayed.one_cycle_delay = true;
  std::vector<Connection> all;
  for (const bool same : {true, false}) {
    const std::string where = same ? "InOneThread" : "BetweenThreads";
    all.push_back({"Latest" + where, latest, same});
    all.push_back({"RefusingFifo" + where, refusing, same});
    all.push_back({"DroppingFifo" + where, dropping, same});
    all.push_back({"Delayed" + where, delayed, same});
  }
  return all;
}

class PortFunctions : public ::testing::TestWithParam<Connection> {
 protected:
  void SetUp() override {
    Host::assign_context(source_, here_);
    Host::assign_context(sink_, GetParam().same_thread ? here_ : there_);
    for (Component* component :
         {static_cast<Component*>(&source_), static_cast<Component*>(&sink_)})
      ASSERT_TRUE(Host::configure(*component));
    face(source_.number).prepare();
    face(source_.vector).prepare();
  }
  void connect(OutputPortBase& output, InputPortBase& input) {
    output.connect(input, GetParam().policy);
    ASSERT_TRUE(Host::start(sink_));
  }
  /// What the reader's thread does with what was sent to it.
  void begin_cycle() {
    ExecutionContext& context = Host::context(sink_);
    ++context.cycle;
    for (rt::Inbox* inbox : {&context.next_cycle, &context.inbox}) inbox->deliver_all();
  }

  ExecutionContext here_{"here"};
  ExecutionContext there_{"there"};
  Source source_{"source"};
  Sink sink_{"sink"};
};

TEST_P(PortFunctions, ANumberIsWrittenAndRead) {
  connect(face(source_.number), face(sink_.number));
  double sum = 0.0;
  expect_realtime("OutputPort::write", [&] { source_.number.write(1.0); });
  expect_realtime("OutputPortBase::take_over_from",
                  [&] { face(source_.number).take_over_from(&face(source_.number)); });
  const double* taken = nullptr;
  expect_realtime("OutputPort::taken_over", [&] { taken = source_.number.taken_over(); });
  EXPECT_EQ(*taken, 1.0);
  face(source_.number).take_over_from(nullptr);
  const double given = 2.0;
  expect_realtime("OutputPortBase::write_from", [&] { face(source_.number).write_from(&given); });
  const auto tap = face(source_.number).make_tap(4, &given);
  const Sample<double> pushed{given, {}, 1};
  expect_realtime("OutputPortBase::attach", [&] {
    face(source_.number).attach(*tap);
    source_.number.write(1.0);
    face(source_.number).detach(*tap);
  });
  expect_realtime("AttachedTap::push", [&] { tap->push(&pushed); });
  expect_realtime("InputPort::read", [&] {
    begin_cycle();
    source_.number.write(2.0);
    sum += sink_.number.read().value;
  });
  EXPECT_GT(sum, 0.0);
}

TEST_P(PortFunctions, AVectorIsWrittenAndRead) {
  connect(face(source_.vector), face(sink_.vector));
  const std::vector<double> wrong_size(3, 1.0);
  const std::vector<double> right_size(7, 1.0);
  expect_realtime("OutputPort::write", [&] {
    source_.vector.write(right_size);
    source_.vector.write(wrong_size);
  });
  EXPECT_EQ(face(source_.vector).counters().wrong_size, 101u);
  double sum = 0.0;
  expect_realtime("InputPort::read", [&] {
    begin_cycle();
    source_.vector.write(right_size);
    sum += sink_.vector.read().value[6];
  });
  EXPECT_GT(sum, 0.0);
}

TEST_P(PortFunctions, AWriteRunsTheHandler) {
  connect(face(source_.number), face(sink_.triggering));
  expect_realtime("OutputPort::write", [&] {
    source_.number.write(1.0);
    begin_cycle();
  });
  EXPECT_GE(sink_.handled, 100);
}

TEST_P(PortFunctions, ATappedWriteHasTheSameMeans) {
  connect(face(source_.number), face(sink_.number));
  Tap& numbers = face(source_.number).tap(50);  // of which it becomes full
  Tap& vectors = face(source_.vector).tap(50, 2);
  const std::vector<double> vector(7, 1.0);
  expect_realtime("OutputPort::write", [&] {
    source_.number.write(1.0);
    source_.vector.write(vector);
  });
  EXPECT_EQ(numbers.dropped(), 51u);
  TappedSample sample;
  EXPECT_TRUE(vectors.take(sample));
}

INSTANTIATE_TEST_SUITE_P(Connections, PortFunctions, ::testing::ValuesIn(connections()),
                         [](const auto& each) { return each.param.name; });

class AgeFunctions : public ::testing::TestWithParam<Reaction> {};

TEST_P(AgeFunctions, DataThatIsTooOldIsReactedTo) {
  ExecutionContext context("here");
  Source source("source");
  Sink sink("sink");
  Host::assign_context(source, context);
  Host::assign_context(sink, context);
  face(sink.number).set_max_age(max_age(milliseconds(1), GetParam()));
  face(source.number).connect(face(sink.number), {});
  ASSERT_TRUE(Host::configure(sink));
  ASSERT_TRUE(Host::start(sink));
  expect_realtime("InputPortBase::check_age", [&] {
    context.cycle_time = context.cycle_time.load() + milliseconds(5);
    face(sink.number).check_age();
  });
  EXPECT_EQ(face(sink.number).counters().stale, 1u);
}

INSTANTIATE_TEST_SUITE_P(Reactions, AgeFunctions,
                         ::testing::Values(Reaction::kHold, Reaction::kZero, Reaction::kStop,
                                           Reaction::kFault),
                         [](const auto& each) { return std::string(name_of(each.param)); });

}  // namespace
}  // namespace armature::component
