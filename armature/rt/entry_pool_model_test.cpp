// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/entry_pool.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

/// What the receiver saw, for entries that know only themselves.
struct Seen {
  int last = 0;
  int count = 0;
};

/// An event on its way, as event handlers have them.
template <typename Atomics>
struct Entry final : BasicMessage<Atomics> {
  Entry() : BasicMessage<Atomics>(&Entry::deliver) {}
  static void deliver(BasicMessage<Atomics>& message) {
    auto& entry = static_cast<Entry&>(message);
    const int value = entry.event;
    entry.in_use.give_back();
    entry.seen->last = value > entry.seen->last ? value : -1;
    ++entry.seen->count;
  }
  model::Data<int> event = 0;
  BasicInUse<Atomics> in_use;
  Seen* seen = nullptr;
};

/// Raises events 1, 2, 3 beside a receiver: each is handled once and in its order, or was dropped
/// because all entries were in use.
template <typename Atomics>
model::Result check_events(std::size_t capacity) {
  return model::explore([capacity](model::Program& program) {
    BasicInbox<Atomics> inbox;
    Seen seen;
    EntryPool<Entry<Atomics>> pool(capacity);
    for (auto& entry : pool) entry.seen = &seen;
    int dropped = 0;
    program.thread("raiser", [&] {
      for (int event = 1; event <= 3; ++event) {
        if (auto* const entry = pool.claim()) {
          entry->event = event;
          inbox.push(*entry);
        } else {
          ++dropped;
        }
      }
    });
    program.thread("receiver", [&] {
      for (int round = 0; round < 2; ++round) {
        inbox.deliver_all();
        program.expect(seen.last >= 0, "an event was handled before an earlier one");
      }
    });
    program.join();
    inbox.deliver_all();
    program.expect(seen.last >= 0, "an event was handled before an earlier one");
    program.expect(seen.count + dropped == 3, "an event was lost or handled twice");
    program.expect(static_cast<std::size_t>(dropped) <= 3 - capacity, "a free entry was not found");
  });
}

TEST(EntryPoolModel, EachEventIsHandledOnceInItsOrderOrDropped) {
  std::uint64_t executions = 0;
  for (const std::size_t capacity : {1u, 2u, 3u}) {
    const model::Result result = check_events<model::Atomics>(capacity);
    EXPECT_EQ(result.failure, "") << "capacity " << capacity;
    executions += result.executions;
  }
  EXPECT_GT(executions, 50u);
  RecordProperty("executions", static_cast<int>(executions));
}

TEST(EntryPoolModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_events<model::AtomicsWithoutRelease>(1).failure, HasSubstr("data race"));
  EXPECT_THAT(check_events<model::AtomicsWithoutAcquire>(1).failure, HasSubstr("data race"));
}

/// Gives an entry back before it has read what is in it.
template <typename Atomics>
struct HastyEntry final : BasicMessage<Atomics> {
  HastyEntry() : BasicMessage<Atomics>(&HastyEntry::deliver) {}
  static void deliver(BasicMessage<Atomics>& message) {
    auto& entry = static_cast<HastyEntry&>(message);
    entry.in_use.give_back();
    static_cast<void>(static_cast<int>(entry.event));
  }
  model::Data<int> event = 0;
  BasicInUse<Atomics> in_use;
};

TEST(EntryPoolModel, TheCheckFindsAnEntryThatIsGivenBackTooEarly) {
  const model::Result result = model::explore([](model::Program& program) {
    BasicInbox<model::Atomics> inbox;
    EntryPool<HastyEntry<model::Atomics>> pool(1);
    program.thread("raiser", [&] {
      for (int event = 1; event <= 2; ++event) {
        if (auto* const entry = pool.claim()) {
          entry->event = event;
          inbox.push(*entry);
        }
      }
    });
    program.thread("receiver", [&] { inbox.deliver_all(); });
    program.join();
  });
  EXPECT_THAT(result.failure, HasSubstr("data race"));
}

}  // namespace
}  // namespace armature::rt
