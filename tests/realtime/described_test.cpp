// SPDX-License-Identifier: Apache-2.0
// Members that are known by a description only, with types that are made while the program runs: an
// event of one component without any C++ gives a command of another one.
#include "armature/component/described.hpp"

#include <memory>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/commands_under_way.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/types/made.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::component {
namespace {

const types::Type& place_type() {
  return *types::made_struct("Place",
                             {{"height", &types::type_of<double>(), "m"},
                              {"gears", types::made_array(types::type_of<float>(), 5).value()},
                              {"name", &types::type_of<base::FixedText<127>>()}})
              .value();
}

Signature of_place() {
  Signature signature;
  signature.arguments = {{"place", &place_type()}, {"quickly", &types::type_of<bool>()}};
  return signature;
}

static_assert(exec::EventCommand::kMost <= CommandsUnderWay::kMost,
              "one connection alone is never refused by what stands for the other process");

/// What a file describes.
class Prototype final : public Component {
 public:
  using Component::Component;
  DescribedEvent seen{*this, "Seen", "something", of_place()};
  DescribedCommand go{*this, "go", "goes there", of_place()};
  DescribedOutput where{*this, {"Where", "it is", {}, place_type()}};
  DescribedInput wish{*this, {"Wish", "where to go", {}, place_type()}};
};

/// Stands for it; completes a command at once.
class Counting final : public StandIn {
 public:
  using StandIn::StandIn;
  int passed_on = 0;
  int begun = 0;
  std::unique_ptr<CommandsUnderWay> under_way;  ///< nullptr: one at a time

  void pass_on(InputPortBase&, const void*) override { ++passed_on; }
  CallStatus call(OperationBase&, const void* const*, void*) override { return CallStatus::kDone; }
  CommandsUnderWay* several(const CommandBase&) override { return under_way.get(); }
  Outcome begin(CommandBase& command, const void* const*) override {
    ++begun;
    if (under_way == nullptr) {
      command.complete();
    } else {
      under_way->end(under_way->newest(), CommandStage::kDone, {});
    }
    return accepted();
  }
  void cancel(CommandBase&) override {}
};

/// @param several  commands may be under way
void expect_realtime_of_made_values(bool several) {
  Prototype prototype("prototype");
  ExecutionContext here{"here"};
  ExecutionContext there{"there"};
  Counting one("one");
  Counting other("other");
  const auto seen = prototype.seen.twin(one);
  const auto where = prototype.where.twin(one);
  const auto go = prototype.go.twin(other);
  const auto wish = prototype.wish.twin(other);
  auto& command = static_cast<CommandBase&>(*go);
  if (several) other.under_way = std::make_unique<CommandsUnderWay>(command);
  std::vector<component::CallParameter> parameters(2);
  parameters[1].member = 1;
  exec::EventCommand wire("wire", *seen, command, parameters, base::Duration::zero());
  Host::assign_context(one, here);
  Host::assign_context(wire, here);
  Host::assign_context(other, there);
  for (Component* each : {static_cast<Component*>(&one), static_cast<Component*>(&wire),
                          static_cast<Component*>(&other)}) {
    ASSERT_TRUE(Host::configure(*each));
  }
  where->connect(*wish, {});
  seen->subscribe(*interface_of(wire).handlers.front());
  interface_of(wire).callers.front()->connect(*go);
  for (Component* each : {static_cast<Component*>(&one), static_cast<Component*>(&wire),
                          static_cast<Component*>(&other)}) {
    ASSERT_TRUE(Host::activate(*each));
    ASSERT_TRUE(Host::start(*each));
  }
  types::Value place(place_type());
  const bool quickly = true;
  const void* const members[] = {place.data(), &quickly};
  expect_realtime("EventBase::raise_from", [&] {
    static_cast<void>(seen->raise_from(members));
    static_cast<void>(where->write_from(place.data()));
    for (int round = 0; round < 2; ++round) {
      for (ExecutionContext* context : {&here, &there}) {
        ++context->cycle;
        context->cycle_time = context->cycle_time.load() + std::chrono::milliseconds(1);
        context->inbox.deliver_all();
      }
    }
  });
  EXPECT_EQ(other.begun, 101);
  EXPECT_EQ(other.passed_on, 101);
  seen->unsubscribe_all();
  interface_of(wire).callers.front()->disconnect();
  where->disconnect_all();
  other.under_way.reset();
}

TEST(Described, EventsCommandsAndPortsCarryMadeValues) { expect_realtime_of_made_values(false); }

TEST(Described, SoDoCommandsOfWhichSeveralMayBeUnderWay) { expect_realtime_of_made_values(true); }

TEST(Described, SeveralRunsOfACommandEndOneByOneOrTogether) {
  Prototype prototype("prototype");
  Counting other("other");
  const auto go = prototype.go.twin(other);
  CommandsUnderWay all(static_cast<CommandBase&>(*go));
  std::size_t left = 0;
  expect_realtime("CommandsUnderWay", [&] {
    while (!all.full()) all.add(nullptr);
    all.end(all.newest() - 1, CommandStage::kFailed, "gone");
    all.end(all.newest(), CommandStage::kDone, {});
    left = all.has(all.newest()) ? 0 : all.size();
    all.end_all(CommandStage::kCancelled, "another mode");
  });
  EXPECT_EQ(left, CommandsUnderWay::kMost - 2);
  EXPECT_EQ(all.size(), 0u);
}

}  // namespace
}  // namespace armature::component
