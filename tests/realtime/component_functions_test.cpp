// SPDX-License-Identifier: Apache-2.0
// Components, properties, operations, commands, events, state machines.
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/events/event_tap.hpp"
#include "armature/component/host.hpp"
#include "armature/component/observing/cycle_record.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/periodic_schedule.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::component {
namespace {

using std::chrono::milliseconds;

struct EffortLimits {
  double effort = 1.0;
};

class Server final : public Component {
 public:
  using Component::Component;

  int calls = 0;
  double add(double a, const std::vector<double>& b) {
    ++calls;
    return a + b.front();
  }
  Outcome begin_move(const std::vector<double>& target) {
    return target.front() < 0.0 ? refused("below zero") : accepted();
  }
  void forget() { ++calls; }
  bool is_far() { return true; }

  using Component::error;
  using Component::log_debug;
  using Component::log_error;
  using Component::log_info;
  using Component::log_warning;

  Properties<EffortLimits> limits{this, {}, member(&EffortLimits::effort, "MaxEffort", "at most")};
  Property<std::vector<double>> gains{this, "Gains", {1.0, 2.0}, "", "", changeable_while_running};
  Operation<double(double, const std::vector<double>&)> add_{this, "add", serve<&Server::add>, ""};
  Operation<double(double, const std::vector<double>&)> queued_{this, "queued", serve<&Server::add>,
                                                                "", in_own_thread};
  Command<const std::vector<double>&> move{this, "move", serve<&Server::begin_move>, "",
                                           cancelled_by<&Server::forget>};
  Event<double, int> happened{this, "happened", "", {}};
  OperatorsWord at_home{this, "at_home", ""};
  Trigger forth{"forth"};
  Trigger back{"back"};
  StateMachine machine{
      this, "machine", "", in_state("A", during<&Server::forget>, on(forth, to("B"))),
      in_state(
          "B", entering<&Server::forget>, leaving<&Server::forget>,
          in_state("Near", when<&Server::is_far>(to("Far"))),
          in_state("Far", on(back, guarded_by<&Server::is_far>, doing<&Server::forget>, to("A"))))};
};

class Client final : public Component {
 public:
  using Component::Component;

  int heard = 0;
  void hear(const double&, const int&) { ++heard; }

  OperationCaller<double(double, const std::vector<double>&)> add{this, "add", ""};
  OperationCaller<double(double, const std::vector<double>&)> queued{this, "queued", ""};
  CommandCaller<const std::vector<double>&> move{this, "move", ""};
  EventHandler<double, int> on_happened{this, "happened", serve<&Client::hear>, ""};
};

/// Client and server in two threads, or in one.
class ComponentFunctions : public ::testing::TestWithParam<bool> {
 protected:
  ComponentFunctions() {
    Host::assign_context(client_, here_);
    Host::assign_context(server_, GetParam() ? here_ : there_);
    face(client_.add).connect(face(server_.add_));
    face(client_.queued).connect(face(server_.queued_));
    face(client_.move).connect(face(server_.move));
    face(server_.happened).subscribe(face(client_.on_happened));
    client_.queued.prepare(1.0, vector_);
    there_.log = &log_;
    here_.log = &log_;
    for (Component* each : {static_cast<Component*>(&client_), static_cast<Component*>(&server_)}) {
      EXPECT_TRUE(Host::configure(*each));
      EXPECT_TRUE(Host::start(*each));
    }
    // A sent vector has found its size once.
    for (std::size_t i = 0; i < kDefaultOutstanding; ++i) {
      static_cast<void>(client_.move.send(vector_));
      deliver();
      server_.move.complete();
    }
  }
  ~ComponentFunctions() override {
    face(server_.happened).unsubscribe_all();
    for (auto* caller : interface_of(client_).callers) caller->disconnect();
  }

  void deliver() {
    for (ExecutionContext* context : {&here_, &there_}) context->inbox.deliver_all();
  }

  ExecutionContext here_{"here"};
  ExecutionContext there_{"there"};
  rt::LogQueue log_{8};
  Server server_{"server"};
  Client client_{"client"};
  const std::vector<double> vector_{1.0, 2.0, 3.0};
};

INSTANTIATE_TEST_SUITE_P(Threads, ComponentFunctions, ::testing::Bool(), [](const auto& each) {
  return std::string(each.param ? "InOneThread" : "BetweenThreads");
});

TEST_P(ComponentFunctions, TimeAndAdmission) {
  base::Time now{};
  bool admitted = false;
  expect_realtime("Component::time", [&] { now = server_.time(); });
  expect_realtime("Host::admits", [&] { admitted = Host::admits(server_); });
  base::Time expiry{};
  expect_realtime("Host::next_expiry", [&] { expiry = Host::next_expiry(server_); });
  EXPECT_GT(expiry, now);
  base::Time hold{};
  expect_realtime("Host::settle_ages", [&] { hold = Host::settle_ages(server_); });
  EXPECT_GE(hold, now);
  Host::set_pace(server_, {.period = milliseconds(10), .owner = &server_});
  base::Duration period{};
  expect_realtime("Component::period", [&] { period = server_.period(); });
  EXPECT_EQ(period, milliseconds(10));
  Host::context(server_).simulated = true;
  bool simulated = false;
  expect_realtime("Component::is_simulated", [&] { simulated = server_.is_simulated(); });
  Host::context(server_).simulated = false;
  EXPECT_TRUE(simulated);
  EXPECT_TRUE(admitted);
}

TEST_P(ComponentFunctions, UpdateAndRun) {
  expect_realtime("Host::update", [&] { Host::update(server_); });
  int runs = 0;
  expect_realtime("Host::run", [&] { Host::run(server_, here_, [&] { ++runs; }); });
  EXPECT_EQ(runs, 101);
}

TEST_P(ComponentFunctions, Measurements) {
  here_.measuring = true;
  expect_realtime("Host::close_measurements", [&] {
    Host::run(client_, here_, [] {});
    Host::close_measurements(here_);
  });
  EXPECT_EQ(Host::execution_ticks(client_).summary().count, 101u);
}

TEST_P(ComponentFunctions, HandlersThatSetThemselvesOff) {
  expect_realtime("Entrance::refuse", [&] { face(client_.on_happened).refuse(here_); });
  EXPECT_EQ(client_.state(), State::kException);
}

TEST_P(ComponentFunctions, CodeThatNestsTooDeeply) {
  here_.limit_depth(0);
  int runs = 0;
  expect_realtime("Host::run", [&] { Host::run(client_, here_, [&] { ++runs; }); });
  EXPECT_EQ(runs, 0);
  EXPECT_EQ(client_.state(), State::kException);
}

TEST_P(ComponentFunctions, ErrorAndFault) {
  expect_realtime("Component::error", [&] { server_.error("a reason"); });
  EXPECT_EQ(server_.state(), State::kRunTimeError);
  expect_realtime("Component::fault", [&] { server_.fault("another reason"); });
  EXPECT_EQ(server_.state(), State::kException);
}

TEST_P(ComponentFunctions, Logging) {
  expect_realtime("Component::log_debug", [&] {
    server_.log_debug("{} {} {} {}", 1, 2.0, true, "text");
    server_.log_info("{}", 1);
    server_.log_warning("{}", std::string_view("text"));
    server_.log_error("nothing more");
  });
  EXPECT_GT(log_.dropped(), 0u);
}

TEST_P(ComponentFunctions, Properties) {
  double sum = 0.0;
  expect_realtime("Property::get", [&] { sum += server_.gains.get()[1]; });
  EXPECT_EQ(sum, 202.0);
  types::Value other = types::Value::of(std::vector<double>{3.0, 4.0, 5.0});
  expect_realtime("Properties::get", [&] { sum += server_.limits.get().effort; });
  expect_realtime("Properties::operator->", [&] { sum += server_.limits->effort; });
  expect_realtime("PropertyBase::swap", [&] { server_.gains.swap(other); });
  EXPECT_EQ(server_.gains.get().size(), 3u);
  EXPECT_TRUE(server_.at_home.set(types::Value::of(true)));
  bool said = false;
  expect_realtime("OperatorsWord::said", [&] { said = server_.at_home.said(); });
  EXPECT_TRUE(said);
}

TEST_P(ComponentFunctions, AChangeOfATappedProperty) {
  Tap& tap = server_.gains.tap(50);
  const std::vector<double> gains[] = {{1.0, 5.0}, {2.0, 5.0}};
  int changes = 0;
  expect_realtime("Property::assign", [&] { server_.gains.assign(gains[++changes % 2]); });
  EXPECT_EQ(tap.dropped(), 52u);  // of 101 changes and the value before
  server_.gains.untap();
}

class CountingTap final : public EventTap {
 public:
  int seen = 0;

 private:
  void event_raised(const void* const*) noexcept override { ++seen; }
};

TEST_P(ComponentFunctions, ATapOfAnEvent) {
  CountingTap tap;
  expect_realtime("EventBase::add_tap", [&] {
    face(server_.happened).add_tap(tap);
    face(server_.happened).remove_tap(tap);
  });
  face(server_.happened).add_tap(tap);
  expect_realtime("EventTap::event_raised", [&] {
    server_.happened.raise(1.0, 2);
    deliver();
  });
  EXPECT_EQ(tap.seen, 101);
  const double place = 1.0;
  const int number = 2;
  const void* const arguments[] = {&place, &number};
  expect_realtime("EventBase::raise_from", [&] {
    face(server_.happened).raise_from(arguments);
    deliver();
  });
}

TEST(BlackBoxFunctions, PicturesAndNotes) {
  ExecutionContext context("thread");
  Server server("server");
  BlackBox box;
  box.add(server);
  box.reserve(4, 4, std::chrono::milliseconds(1));
  Host::assign_context(server, context);
  context.black_box = &box;
  bool due = false;
  std::int64_t now = 0;
  const auto time = [&] { return base::time_from_ns(now); };
  expect_realtime("BlackBox::due", [&] { due = box.due(time()); });
  EXPECT_TRUE(due);
  expect_realtime("BlackBox::make_picture", [&] {
    now += 1'000'000;
    box.make_picture(time());
  });
  expect_realtime("BlackBox::note",
                  [&] { box.note(BlackBox::Note::Kind::kFault, server, "item", "text"); });
  expect_realtime("component::note",
                  [&] { note(server, BlackBox::Note::Kind::kCall, "item", "text"); });
  EXPECT_EQ(box.missed(), 0u);
}

TEST(TimelineFunctions, AStretchWithSteps) {
  const Server first("first");
  const Server second("second");
  Timeline timeline({.capacity = 50, .burst = std::chrono::seconds(1)});  // it becomes full
  bool affords = false;
  expect_realtime("Timeline::open", [&] { timeline.open(0, base::Time(), 100); });
  expect_realtime("Timeline::affords_steps", [&] { affords = timeline.affords_steps(); });
  EXPECT_FALSE(affords);  // what found no room is not kept
  while (timeline.pop() != nullptr) continue;
  timeline.open(0, base::Time(), 100);
  std::uint64_t tick = 100;
  expect_realtime("Timeline::add_step", [&] {
    timeline.add_step(&first, tick, tick + 1);
    timeline.add_step(&second, tick + 1, tick + 2);
    tick += 2;
  });
  expect_realtime("Timeline::close", [&] { timeline.close(tick, 1, base::Time(), true, true); });
  expect_realtime("Timeline::spend", [&] { timeline.spend(1); });
  expect_realtime("Timeline::pushed", [&] { tick = timeline.pushed(); });
  EXPECT_GT(timeline.dropped(), 0u);
}

TEST(CycleRecordFunctions, ACycleWithMoreStepsThanThereIsRoomFor) {
  const Server first("first");
  const Server second("second");
  CycleRecord record(50);
  std::uint64_t tick = 100;
  expect_realtime("CycleRecord::open", [&] { record.open(1, base::Time(), tick); });
  expect_realtime("CycleRecord::add_step", [&] {
    record.add_step(&first, tick, tick + 1);
    record.add_step(&second, tick + 1, tick + 2);
    tick += 2;
  });
  expect_realtime("CycleRecord::close", [&] { record.close(tick); });
  EXPECT_GT(record.left_out(), 0u);
}

TEST_P(ComponentFunctions, AnOperationInTheCallersThread) {
  double sum = 0.0;
  expect_realtime("OperationCaller::operator()", [&] { sum += client_.add(1.0, vector_).value; });
  EXPECT_EQ(sum, 202.0);
}

TEST_P(ComponentFunctions, AnOperationInItsOwnThread) {
  double sum = 0.0;
  expect_realtime("OperationCaller::send", [&] {
    const SendHandle<double> handle = client_.queued.send(1.0, vector_);
    deliver();
    sum += handle.collect().value;
  });
  EXPECT_EQ(sum, 202.0);
  bool pending = true;
  expect_realtime("SendHandle::collect", [&] {
    const SendHandle<double> handle = client_.queued.send(1.0, vector_);
    pending = pending && handle.collect().status == CallStatus::kPending;
    deliver();
    sum += handle.collect().value;
  });
  EXPECT_TRUE(pending);
  bool cancelled = true;
  expect_realtime("SentCall::cancel", [&] {
    SendHandle<double> handle = client_.queued.send(1.0, vector_);
    cancelled = cancelled && handle.cancel();
    deliver();
  });
  EXPECT_TRUE(cancelled);
}

TEST_P(ComponentFunctions, TooManyCallsAtOnce) {
  expect_realtime("OperationCaller::send",
                  [&] { static_cast<void>(client_.queued.send(1.0, vector_)); });
  EXPECT_EQ(face(client_.queued).refused(), 101u - kDefaultOutstanding);
  deliver();
}

TEST_P(ComponentFunctions, ACommandToEachOfItsEnds) {
  CommandStage stage = CommandStage::kFree;
  const auto run = [&](auto&& end) {
    CommandHandle handle = client_.move.send(vector_);
    deliver();
    end(handle);
    deliver();
    stage = handle.stage();
  };
  expect_realtime("CommandCaller::send",
                  [&] { run([&](CommandHandle&) { server_.move.complete(); }); });
  EXPECT_EQ(stage, CommandStage::kDone);
  expect_realtime("CommandBase::report", [&] {
    run([&](CommandHandle&) {
      server_.move.report(0.5);
      server_.move.fail("it is blocked");
    });
  });
  EXPECT_EQ(stage, CommandStage::kFailed);
  expect_realtime("CommandCaller::send",
                  [&] { run([&](CommandHandle& handle) { handle.cancel(); }); });
  EXPECT_EQ(stage, CommandStage::kCancelled);
}

TEST_P(ComponentFunctions, Events) {
  expect_realtime("Event::raise", [&] {
    server_.happened.raise(1.0, 2);
    deliver();
  });
  EXPECT_EQ(client_.heard, 101);
  // A full queue is no exception.
  expect_realtime("Event::raise", [&] { server_.happened.raise(1.0, 2); });
  deliver();
}

TEST_P(ComponentFunctions, StateMachines) {
  std::string_view path;
  bool far = true;
  int states = 0;
  const auto round = [&] {
    server_.forth.raise();
    Host::update(server_);  // from near to far
    path = server_.machine.path();
    far = far && server_.machine.is_in("B/Far");
    states += server_.machine.current();
    server_.back.raise();
  };
  expect_realtime("Trigger::raise", round);
  expect_realtime("StateMachine::path", round);
  expect_realtime("StateMachine::is_in", round);
  expect_realtime("StateMachine::current", round);
  EXPECT_EQ(path, "B/Far");
  EXPECT_TRUE(far);
  EXPECT_EQ(server_.machine.transitions_taken(), 4u * 101u * 3u);
  TriggerStatus status = TriggerStatus::kNotRunning;
  expect_realtime("StateMachine::post", [&] { status = server_.machine.post(0); });
  EXPECT_NE(status, TriggerStatus::kNotRunning);
}

struct Nothing final : rt::Message {
  Nothing() : rt::Message([](rt::Message&) {}) {}
};

TEST(RealtimeContexts, MessagesArePosted) {
  ExecutionContext context("here");
  context.wakes_on_messages = true;
  Nothing message;
  expect_realtime("ExecutionContext::post", [&] {
    context.post(message);
    context.inbox.take_all();
  });
  expect_realtime("ExecutionContext::flush", [&] { context.flush(); });
}

TEST(RealtimeContexts, ScheduleSettles) {
  exec::PeriodicSchedule schedule(milliseconds(1), false);
  base::Time now{};
  schedule.begin(now);
  expect_realtime("PeriodicSchedule::settle", [&] { schedule.settle(now += milliseconds(2)); });
  EXPECT_EQ(schedule.cycles_run(), 101u);
  EXPECT_EQ(schedule.cycles_skipped(), 101u);
}

}  // namespace
}  // namespace armature::component
