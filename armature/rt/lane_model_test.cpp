// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/passage.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

struct Value {
  std::uint64_t sequence = 0;
};

/// What a connection's channel does: batches while one is free, else a cell and a signal.
template <typename Atomics, typename Way = Passage<Value, Atomics>>
class Connection final : public Recipient, public BasicSignal<Atomics> {
 public:
  Connection(BasicLane<Atomics>& lane, BasicInbox<Atomics>& inbox, model::Program& program)
      : BasicSignal<Atomics>(&Connection::deliver), lane_(lane), inbox_(inbox), program_(program) {}

  void write(std::uint64_t sequence) {
    const Value value{sequence};
    if (way_.write(value, lane_.add(*this, sizeof value))) return;
    lane_.send();
    this->raise(inbox_);
  }

  std::uint64_t last = 0;

 private:
  std::size_t receive(const std::byte* data) override {
    take(way_.receive(data));
    return sizeof(Value);
  }
  static void deliver(BasicMessage<Atomics>& message) {
    auto& self = static_cast<Connection&>(message);
    self.lower();
    self.take(self.way_.fetch());
  }
  void take(const Value* value) {
    if (value == nullptr) return;
    program_.expect(value->sequence > last, "an older value came after a newer one");
    last = value->sequence;
  }

  BasicLane<Atomics>& lane_;
  BasicInbox<Atomics>& inbox_;
  model::Program& program_;
  Way way_{Value{}};
};

/// Writes with a `send` behind every `each`, beside a reader: the last value always comes.
template <typename Atomics, typename Way = Passage<Value, Atomics>>
model::Result check_values(std::uint64_t writes, std::uint64_t each, int rounds) {
  return model::explore([=](model::Program& program) {
    BasicInbox<Atomics> inbox;
    BasicLane<Atomics> lane(inbox);
    Connection<Atomics, Way> connection(lane, inbox, program);
    lane.reserve(sizeof(Value));
    lane.prepare();
    program.thread("writer", [&] {
      for (std::uint64_t sequence = 1; sequence <= writes; ++sequence) {
        connection.write(sequence);
        if (sequence % each == 0) lane.send();
      }
      lane.send();
    });
    program.thread("reader", [&] {
      for (int round = 0; round < rounds; ++round) inbox.deliver_all();
    });
    program.join();
    inbox.deliver_all();
    program.expect(connection.last == writes, "the last value is lost");
  });
}

TEST(LaneModel, TheLastValueComesAndNoneAfterANewerOne) {
  std::uint64_t executions = 0;
  // Five are more than there are batches: some take the other way.
  for (const std::uint64_t each : {1u, 2u}) {
    const model::Result result = check_values<model::Atomics>(5, each, 2);
    EXPECT_EQ(result.failure, "") << "sent in batches of " << each;
    executions += result.executions;
  }
  EXPECT_GT(executions, 1000u);
  RecordProperty("executions", static_cast<int>(executions));
}

TEST(LaneModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_values<model::AtomicsWithoutRelease>(4, 1, 1).failure, HasSubstr("data race"));
  EXPECT_THAT(check_values<model::AtomicsWithoutAcquire>(4, 1, 1).failure, HasSubstr("data race"));
}

/// Takes what a batch brings without asking whether something newer came by the other way.
template <typename Atomics>
class Trusting : public Passage<Value, Atomics> {
 public:
  using Passage<Value, Atomics>::Passage;
  const Value* receive(const std::byte* data) {
    std::memcpy(&received_, data, sizeof received_);
    return &received_;
  }

 private:
  Value received_;
};

TEST(LaneModel, TheCheckFindsAReaderThatTrustsTheOrderOfArrival) {
  const auto result = check_values<model::Atomics, Trusting<model::Atomics>>(6, 1, 2);
  EXPECT_THAT(result.failure, HasSubstr("an older value came after a newer one"));
}

/// A batch that may be gathered again before it was read to its end.
template <typename Atomics>
struct HastyBatch final : BasicMessage<Atomics> {
  HastyBatch() : BasicMessage<Atomics>(&HastyBatch::deliver) {}
  static void deliver(BasicMessage<Atomics>& message) {
    auto& self = static_cast<HastyBatch&>(message);
    self.in_use.give_back();
    static_cast<void>(static_cast<int>(self.used));
  }
  model::Data<int> used = 0;
  BasicInUse<Atomics> in_use;
};

TEST(LaneModel, TheCheckFindsABatchThatIsGivenBackTooEarly) {
  const model::Result result = model::explore([](model::Program& program) {
    BasicInbox<model::Atomics> inbox;
    EntryPool<HastyBatch<model::Atomics>> batches(1);
    program.thread("writer", [&] {
      for (int round = 0; round < 2; ++round) {
        if (auto* const batch = batches.claim()) {
          batch->used = round;
          inbox.push(*batch);
        }
      }
    });
    program.thread("reader", [&] { inbox.deliver_all(); });
    program.join();
  });
  EXPECT_THAT(result.failure, HasSubstr("data race"));
}

}  // namespace
}  // namespace armature::rt
