// SPDX-License-Identifier: Apache-2.0
// Twins: what a component that stands for another one has in place of the other's members.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/component/operations/commands_under_way.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/rt/guard.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

class Original final : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, ""};
  OutputPort<double> position{this, "Position", "where it is", "rad"};
  Property<std::string> unit{this, "Unit", "rad", ""};
  OutputPort<std::vector<double>> all{this, "All", "", "", unit_of(unit), size_of(joints)};
  InputPort<double> reference{this, "Reference", "where to go", "rad", on_data<&Original::handle>};
  Operation<double(double)> twice{this, "twice", serve<&Original::serve_twice>, "doubles",
                                  args("x")};
  Operation<void()> arm{this, "arm", serve<&Original::serve_arm>, "", by_operator};
  Command<double> travel{this, "travel", serve<&Original::serve_travel>, "", args("target [m]")};
  Event<int, double> reached{this, "Reached", "", {"number", "place [m]"}};

 private:
  void handle(double) {}
  double serve_twice(double x) { return 2.0 * x; }
  void serve_arm() {}
  Outcome serve_travel(double) { return accepted(); }
};

/// Notes what it is to pass on.
class Notes final : public StandIn {
 public:
  using StandIn::StandIn;
  std::vector<std::string> notes;
  CallStatus answer = CallStatus::kDone;
  bool begins = true;
  std::unique_ptr<CommandsUnderWay> under_way;  ///< of its command; nullptr: one at a time

  void pass_on(InputPortBase& input, const void* value) override {
    notes.push_back(input.name() + "=" + std::to_string(*static_cast<const double*>(value)));
  }
  CallStatus call(OperationBase& operation, const void* const* arguments, void* result) override {
    notes.push_back(std::string(operation.name()));
    if (result != nullptr) {
      *static_cast<double*>(result) = 10.0 * *static_cast<const double*>(arguments[0]);
    }
    return answer;
  }
  CommandsUnderWay* several(const CommandBase& /*command*/) override { return under_way.get(); }
  Outcome begin(CommandBase& command, const void* const* arguments) override {
    if (!begins) return refused("it cannot be reached");
    notes.push_back(std::string(command.name()) + " " +
                    std::to_string(*static_cast<const double*>(arguments[0])));
    return accepted();
  }
  void cancel(CommandBase& command) override {
    notes.push_back("cancel " + std::string(command.name()));
  }
};

class User final : public Component {
 public:
  using Component::Component;
  OutputPort<double> wish{this, "Wish", ""};
  InputPort<double> position{this, "Position", ""};
  OperationCaller<double(double)> twice{this, "twice", ""};
  CommandCaller<double> travel{this, "travel", "", outstanding(20)};
  EventHandler<int, double> reached{this, "Reached", serve<&User::note>, ""};
  std::vector<double> heard;

 private:
  void note(int number, double place) { heard.push_back(number + place); }
};

struct Twins : testing::Test {
  Twins() {
    thread.add(notes, user);
    output = face(original.position).twin(notes);
    all = face(original.all).twin(notes);
    input = face(original.reference).twin(notes);
    twice = face(original.twice).twin(notes);
    arm = face(original.arm).twin(notes);
    travel = face(original.travel).twin(notes);
    reached = face(original.reached).twin(notes);
    output->prepare();
    all->prepare();
    output->connect(face(user.position), {});
    face(user.wish).connect(*input, {});
    face(user.twice).connect(*twice);
    face(user.travel).connect(*travel);
    reached->subscribe(face(user.reached));
    for (Component* each : {static_cast<Component*>(&notes), static_cast<Component*>(&user)}) {
      EXPECT_TRUE(Host::configure(*each));
      EXPECT_TRUE(Host::activate(*each));
      EXPECT_TRUE(Host::start(*each));
    }
  }
  TestThread thread;
  Original original{"Original"};
  Notes notes{"Notes"};
  User user{"User"};
  std::unique_ptr<OutputPortBase> output;
  std::unique_ptr<OutputPortBase> all;
  std::unique_ptr<InputPortBase> input;
  std::unique_ptr<OperationBase> twice;
  std::unique_ptr<OperationBase> arm;
  std::unique_ptr<OperationBase> travel;
  std::unique_ptr<EventBase> reached;
};

TEST_F(Twins, AreKnownByTheSameNames) {
  EXPECT_EQ(output->name(), "Position");
  EXPECT_EQ(output->unit(), "rad");
  EXPECT_EQ(all->unit(), "rad") << "which a property of the original says";
  EXPECT_EQ(twice->signature().text(), face(original.twice).signature().text());
  EXPECT_EQ(travel->signature().text(), face(original.travel).signature().text());
  EXPECT_EQ(reached->signature().text(), face(original.reached).signature().text());
  EXPECT_TRUE(travel->is_command());
  EXPECT_TRUE(arm->is_by_operator());
  EXPECT_TRUE(twice->is_elsewhere());
  EXPECT_FALSE(face(original.twice).is_elsewhere());
  EXPECT_EQ(interface_of(notes).outputs.size(), 2u);
  EXPECT_EQ(interface_of(notes).inputs.size(), 1u);
  EXPECT_TRUE(input->stays_open());
}

TEST_F(Twins, OfAnOutputWriteWhatTheyAreGiven) {
  const double value = 1.5;
  EXPECT_EQ(output->write_from(&value), WriteStatus::kWritten);
  EXPECT_EQ(user.position.read().value, 1.5);
  const std::vector<double> three(3);
  EXPECT_EQ(all->write_from(&three), WriteStatus::kWrongSize);  // the original has two joints
}

TEST_F(Twins, OfAnInputPassOnWhatComes) {
  user.wish.write(0.25);
  EXPECT_THAT(notes.notes, ElementsAre("Reference=0.250000"));
}

TEST_F(Twins, OfAnOperationPassOnTheCallAndBringTheAnswer) {
  const CallResult<double> result = user.twice(3.0);
  EXPECT_EQ(result.status, CallStatus::kDone);
  EXPECT_EQ(result.value, 30.0);
  notes.answer = CallStatus::kUnreachable;
  EXPECT_EQ(user.twice(3.0).status, CallStatus::kUnreachable);
  EXPECT_EQ(notes.state(), State::kRunning);  // it is nobody's fault here
}

TEST_F(Twins, OfAnOperationLetNoRealTimeThreadWait) {
  thread.context.real_time = true;
  EXPECT_EQ(user.twice(3.0).status, CallStatus::kWouldWait);
  EXPECT_THAT(notes.notes, ElementsAre());
}

TEST_F(Twins, OfACommandEndWhenTheStandInSaysSo) {
  CommandHandle first = user.travel.send(2.0);
  thread.deliver();
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  auto& command = static_cast<CommandBase&>(*travel);
  command.report(0.5);
  EXPECT_EQ(first.progress(), 0.5);
  command.complete();
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  CommandHandle second = user.travel.send(3.0);
  thread.deliver();
  second.cancel();
  thread.deliver();
  EXPECT_EQ(second.stage(), CommandStage::kCancelled);
  EXPECT_THAT(notes.notes, ElementsAre("travel 2.000000", "travel 3.000000", "cancel travel"));
}

/// The user's command, of which several may be under way.
struct TwinsOfSeveral : Twins {
  TwinsOfSeveral() {
    notes.under_way = std::make_unique<CommandsUnderWay>(static_cast<const CommandBase&>(*travel));
  }
  ~TwinsOfSeveral() override { notes.under_way.reset(); }
  CommandHandle send(double target) {
    CommandHandle sent = user.travel.send(target);
    thread.deliver();
    return sent;
  }
};

TEST_F(TwinsOfSeveral, AreBegunAsTheyComeAndEachEndsOnItsOwn) {
  const CommandHandle first = send(1.0);
  const CommandHandle second = send(2.0);
  const CommandHandle third = send(3.0);
  EXPECT_THAT(notes.notes, ElementsAre("travel 1.000000", "travel 2.000000", "travel 3.000000"));
  EXPECT_EQ(notes.under_way->newest(), 3U);
  notes.under_way->end(2, CommandStage::kFailed, "the rope is worn");
  EXPECT_EQ(first.stage(), CommandStage::kAccepted);
  EXPECT_EQ(second.stage(), CommandStage::kFailed);
  EXPECT_EQ(second.reason(), "the rope is worn");
  notes.under_way->end(1, CommandStage::kDone, "");
  notes.under_way->end(3, CommandStage::kDone, "");
  notes.under_way->end(3, CommandStage::kFailed, "twice");
  EXPECT_EQ(first.stage(), CommandStage::kDone);
  EXPECT_EQ(third.stage(), CommandStage::kDone);
  EXPECT_EQ(notes.under_way->size(), 0U);
}

TEST_F(TwinsOfSeveral, AreBoundedAndTheNextIsRefusedUntilOneEnds) {
  std::vector<CommandHandle> sent;
  for (std::size_t k = 0; k < CommandsUnderWay::kMost; ++k) sent.push_back(send(1.0));
  EXPECT_EQ(send(1.0).reason(), "16 of it are under way in another process, which is the most");
  notes.under_way->end(5, CommandStage::kDone, "");
  EXPECT_EQ(send(1.0).stage(), CommandStage::kAccepted);
  EXPECT_EQ(notes.notes.size(), CommandsUnderWay::kMost + 1);
}

TEST_F(TwinsOfSeveral, WhatIsCancelledEndsHereAloneAndItsAnswerIsNobodys) {
  CommandHandle first = send(1.0);
  const CommandHandle second = send(2.0);
  first.cancel();
  thread.deliver();
  EXPECT_EQ(first.stage(), CommandStage::kCancelled);
  EXPECT_EQ(second.stage(), CommandStage::kAccepted);
  notes.under_way->end(1, CommandStage::kDone, "");
  EXPECT_EQ(first.stage(), CommandStage::kCancelled);
  EXPECT_EQ(second.stage(), CommandStage::kAccepted);
}

TEST_F(TwinsOfSeveral, AllEndWhenTheStandInStops) {
  const CommandHandle first = send(1.0);
  const CommandHandle second = send(2.0);
  Host::stop(notes);
  EXPECT_EQ(first.stage(), CommandStage::kCancelled);
  EXPECT_EQ(second.stage(), CommandStage::kCancelled);
  EXPECT_EQ(send(3.0).reason(), "the component is not running");
}

TEST_F(TwinsOfSeveral, WhatTheStandInRefusesEndsSo) {
  notes.begins = false;
  const CommandHandle refusal = send(1.0);
  EXPECT_EQ(refusal.stage(), CommandStage::kRefused);
  EXPECT_EQ(refusal.reason(), "it cannot be reached");
  EXPECT_EQ(notes.under_way->size(), 0U);
}

TEST_F(Twins, OfAnEventRaiseWhatTheyAreGiven) {
  const int number = 2;
  const double place = 0.5;
  const void* const arguments[] = {&number, &place};
  EXPECT_EQ(reached->raise_from(arguments), RaiseStatus::kDelivered);
  EXPECT_THAT(user.heard, ElementsAre(2.5));
}

TEST(AttachedTap, TakesWhatIsWrittenWhileItIsAttached) {
  Original original("Original");
  const double shape = 0.0;
  const auto tap = face(original.position).make_tap(4, &shape);
  original.position.write(1.0);
  {
    const rt::RealtimeScope real_time;
    face(original.position).attach(*tap);
    original.position.write(2.0);
    face(original.position).detach(*tap);
  }
  original.position.write(3.0);
  TappedSample sample;
  ASSERT_TRUE(tap->take(sample));
  EXPECT_EQ(sample.sequence, 2u);
  EXPECT_FALSE(tap->take(sample));
  EXPECT_FALSE(face(original.position).is_tapped());
}

TEST(Writer, IsAnOutputForAnInputWrittenFromElsewhere) {
  Original original("Original");
  User user("User");
  const auto writer = face(original.reference).make_writer(user, "Original.Reference");
  EXPECT_EQ(writer->name(), "Original.Reference");
  writer->connect(face(original.reference), {});
  const double value = 4.0;
  writer->write_from(&value);
  EXPECT_EQ(original.reference.read().value, 4.0);
}

}  // namespace
}  // namespace armature::component
