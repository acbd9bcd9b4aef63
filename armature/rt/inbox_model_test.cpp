// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/inbox.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

/// A message with something to say, and whoever collects it.
template <typename Atomics>
struct Letter final : BasicMessage<Atomics> {
  explicit Letter(std::vector<int>& collected) : BasicMessage<Atomics>(collect), to(&collected) {}

  static void collect(BasicMessage<Atomics>& message) {
    auto& self = static_cast<Letter&>(message);
    self.to->push_back(self.text);
  }

  std::vector<int>* to;
  model::Data<int> text{0};
};

template <typename Atomics>
void deliver_all(BasicInbox<Atomics>& inbox) {
  auto* message = inbox.take_all();
  while (message != nullptr) {
    auto* const next = inbox.next(*message);
    message->deliver();
    message = next;
  }
}

/// Each sender pushes its own letters, 10 * sender + number, beside an owner that takes twice.
template <typename Atomics>
model::Result check_senders(int senders, int letters_each) {
  return model::explore([=](model::Program& program) {
    BasicInbox<Atomics> inbox;
    std::vector<int> collected;
    std::vector<std::unique_ptr<Letter<Atomics>>> letters;
    for (int i = 0; i < senders * letters_each; ++i) {
      letters.push_back(std::make_unique<Letter<Atomics>>(collected));
    }
    for (int sender = 0; sender < senders; ++sender) {
      program.thread("sender " + std::to_string(sender), [&, sender] {
        for (int i = 0; i < letters_each; ++i) {
          auto& letter = *letters[static_cast<std::size_t>(sender * letters_each + i)];
          letter.text = 10 * sender + i;
          inbox.push(letter);
        }
      });
    }
    program.thread("owner", [&] {
      deliver_all(inbox);
      deliver_all(inbox);
    });
    program.join();
    deliver_all(inbox);
    program.expect(inbox.empty(), "something is left");
    std::vector<int> expected;
    for (int sender = 0; sender < senders; ++sender) {
      for (int i = 0; i < letters_each; ++i) expected.push_back(10 * sender + i);
    }
    // Ordered by sender alone, so that the order of one sender's letters stays as it was.
    std::stable_sort(collected.begin(), collected.end(),
                     [](int a, int b) { return a / 10 < b / 10; });
    program.expect(collected == expected, "a letter is lost, came twice or too early");
  });
}

TEST(InboxModel, EveryMessageIsTakenOnceAndInItsSendersOrder) {
  const model::Result two = check_senders<model::Atomics>(2, 2);
  EXPECT_EQ(two.failure, "");
  const model::Result three = check_senders<model::Atomics>(3, 1);
  EXPECT_EQ(three.failure, "");
  EXPECT_GT(std::min(two.executions, three.executions), 50u);
  RecordProperty("executions", static_cast<int>(two.executions + three.executions));
}

TEST(InboxModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_senders<model::AtomicsWithoutRelease>(2, 1).failure, HasSubstr("data race"));
  EXPECT_THAT(check_senders<model::AtomicsWithoutAcquire>(2, 1).failure, HasSubstr("data race"));
}

TEST(InboxModel, TheCheckFindsAPushInTwoSteps) {
  EXPECT_FALSE(check_senders<model::AtomicsInTwoSteps>(2, 1).ok());
}

TEST(InboxModel, APushThatFollowsAnotherSendersPushComesBehindIt) {
  const model::Result result = model::explore([](model::Program& program) {
    BasicInbox<model::Atomics> inbox;
    std::vector<int> collected;
    Letter<model::Atomics> first(collected);
    Letter<model::Atomics> second(collected);
    model::Atomic<int> pushed(0);
    program.thread("first", [&] {
      first.text = 1;
      inbox.push(first);
      pushed.store(1, model::Order::release);
    });
    program.thread("second", [&] {
      if (pushed.load(model::Order::acquire) == 0) return;
      second.text = 2;
      inbox.push(second);
    });
    program.thread("owner", [&] { deliver_all(inbox); });
    program.join();
    deliver_all(inbox);
    program.expect(std::is_sorted(collected.begin(), collected.end()), "the second came first");
  });
  EXPECT_EQ(result.failure, "");
}

/// A signal whose delivery looks at a value that its senders write.
template <typename Atomics>
struct Bell final : BasicSignal<Atomics> {
  explicit Bell(model::Atomic<int>& watched) : BasicSignal<Atomics>(look), value(watched) {}

  static void look(BasicMessage<Atomics>& message) {
    auto& self = static_cast<Bell&>(message);
    self.lower();
    self.seen = self.value.load(model::Order::relaxed);
  }

  model::Atomic<int>& value;
  int seen = 0;
};

/// Writes and raises three times beside an owner that takes as often.
template <typename Atomics>
model::Result check_signal() {
  return model::explore([](model::Program& program) {
    BasicInbox<Atomics> inbox;
    model::Atomic<int> value(0);
    Bell<Atomics> bell(value);
    program.thread("sender", [&] {
      for (int i = 1; i <= 3; ++i) {
        value.store(i, model::Order::relaxed);
        bell.raise(inbox);
      }
    });
    program.thread("owner", [&] {
      for (int i = 0; i < 3; ++i) deliver_all(inbox);
    });
    program.join();
    deliver_all(inbox);
    program.expect(bell.seen == 3, "what was written before the last raise was not seen");
  });
}

/// Two threads raise the same signal, each after adding its own bit.
template <typename Atomics>
model::Result check_shared_signal() {
  return model::explore([](model::Program& program) {
    BasicInbox<Atomics> inbox;
    model::Atomic<int> value(0);
    Bell<Atomics> bell(value);
    for (const int bit : {1, 2}) {
      program.thread("sender " + std::to_string(bit), [&, bit] {
        value.fetch_add(bit, model::Order::relaxed);
        bell.raise(inbox);
      });
    }
    program.thread("owner", [&] {
      deliver_all(inbox);
      deliver_all(inbox);
    });
    program.join();
    deliver_all(inbox);
    program.expect(bell.seen == 3, "what was written before the last raise was not seen");
  });
}

TEST(SignalModel, NothingWrittenBeforeARaiseIsMissed) {
  const model::Result one = check_signal<model::Atomics>();
  EXPECT_EQ(one.failure, "");
  const model::Result two = check_shared_signal<model::Atomics>();
  EXPECT_EQ(two.failure, "");
  EXPECT_GT(std::min(one.executions, two.executions), 50u);
  RecordProperty("executions", static_cast<int>(one.executions + two.executions));
}

TEST(SignalModel, TheCheckFindsTheShortcutForASignalThatSeemsRaisedAlready) {
  EXPECT_THAT(check_signal<model::AtomicsThatLookFirst>().failure, HasSubstr("was not seen"));
}

TEST(SignalModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_FALSE(check_signal<model::AtomicsWithoutRelease>().ok());
  EXPECT_FALSE(check_signal<model::AtomicsWithoutAcquire>().ok());
}

TEST(SignalModel, TheCheckFindsARaiseInTwoSteps) {
  EXPECT_FALSE(check_signal<model::AtomicsInTwoSteps>().ok());
}

}  // namespace
}  // namespace armature::rt
