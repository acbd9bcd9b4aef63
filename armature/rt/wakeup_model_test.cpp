// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/rt/inbox.hpp"
#include "armature/rt/latest.hpp"
#include "armature/rt/wakeup.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::rt {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;

/// Each notifier adds its bit, then notifies, `times` times; the sleeper sleeps until it has seen
/// everything. A notification that is lost, or does not show what was written before it, leaves the
/// sleeper asleep.
template <typename AnyWakeup>
model::Result check_wakeup(int notifiers, int times) {
  return model::explore([=](model::Program& program) {
    AnyWakeup wakeup;
    model::Atomic<int> count(0);
    for (int i = 0; i < notifiers; ++i) {
      program.thread("notifier " + std::to_string(i), [&] {
        for (int k = 0; k < times; ++k) {
          count.fetch_add(1, model::Order::relaxed);
          wakeup.notify();
        }
      });
    }
    program.thread("sleeper", [&] {
      while (count.load(model::Order::relaxed) < notifiers * times) wakeup.wait();
    });
    program.join();
  });
}

TEST(WakeupModel, NoNotificationIsLost) {
  const model::Result one = check_wakeup<BasicWakeup<model::Parker>>(1, 3);
  EXPECT_EQ(one.failure, "");
  const model::Result two = check_wakeup<BasicWakeup<model::Parker>>(2, 1);
  EXPECT_EQ(two.failure, "");
  EXPECT_GT(std::min(one.executions, two.executions), 50u);
  RecordProperty("executions", static_cast<int>(one.executions + two.executions));
}

template <typename Atomics>
model::Result check_wakeup_of() {
  return check_wakeup<BasicWakeup<model::ParkerOf<Atomics>>>(1, 2);
}

TEST(WakeupModel, TheCheckFindsMissingMemoryOrders) {
  const char* const lost = "sleeper sleeps for ever";
  EXPECT_THAT(check_wakeup_of<model::AtomicsWithoutRelease>().failure, HasSubstr(lost));
  EXPECT_THAT(check_wakeup_of<model::AtomicsWithoutAcquire>().failure, HasSubstr(lost));
}

TEST(WakeupModel, TheCheckFindsANotificationInTwoSteps) {
  EXPECT_THAT(check_wakeup_of<model::AtomicsInTwoSteps>().failure,
              HasSubstr("sleeper sleeps for ever"));
}

TEST(WakeupModel, TheCheckFindsTheShortcutForANotificationThatSeemsPending) {
  EXPECT_THAT(check_wakeup_of<model::AtomicsThatLookFirst>().failure,
              HasSubstr("sleeper sleeps for ever"));
}

/// The classic mistake: each side stores its own flag, then loads the other's, and nothing keeps
/// the store ahead of the load; so both may miss each other.
class WakeupWithoutFence {
 public:
  void notify() {
    pending_.store(1, model::Order::release);
    if (asleep_.load(model::Order::acquire) == 1) {
      asleep_.store(0, model::Order::release);
      model::Parker::wake_one(asleep_);
    }
  }
  void wait() {
    asleep_.store(1, model::Order::release);
    if (pending_.load(model::Order::acquire) == 0) model::Parker::wait(asleep_, 1);
    asleep_.store(0, model::Order::release);
    pending_.store(0, model::Order::release);
  }

 private:
  model::Atomic<std::uint32_t> pending_{0};
  model::Atomic<std::uint32_t> asleep_{0};
};

TEST(WakeupModel, TheCheckFindsAMissingFenceBetweenStoreAndLoad) {
  EXPECT_THAT(check_wakeup<WakeupWithoutFence>(1, 1).failure, HasSubstr("sleeper sleeps for ever"));
}

TEST(WakeupModel, ANotificationBesideADeadlineIsTakenOrKept) {
  const model::Result result = model::explore([](model::Program& program) {
    BasicWakeup<model::Parker> wakeup;
    model::Atomic<int> written(0);
    program.thread("notifier", [&] {
      written.store(1, model::Order::relaxed);
      wakeup.notify();
    });
    program.thread("sleeper", [&] {
      if (!wakeup.wait_until(base::Time{})) wakeup.wait();
      program.expect(written.load(model::Order::relaxed) == 1, "woken without a notification");
      program.expect(!wakeup.try_wait(), "one notification counted twice");
    });
    program.join();
  });
  EXPECT_EQ(result.failure, "");
}

TEST(WakeupModel, TryWaitTakesWhatHappenedBefore) {
  const model::Result result = model::explore([](model::Program& program) {
    BasicWakeup<model::Parker> wakeup;
    model::Atomic<int> written(0);
    program.thread("notifier", [&] {
      written.store(1, model::Order::relaxed);
      wakeup.notify();
    });
    program.thread("sleeper", [&] {
      if (!wakeup.try_wait()) wakeup.wait();
      program.expect(written.load(model::Order::relaxed) == 1, "the write was not seen");
    });
    program.join();
  });
  EXPECT_EQ(result.failure, "");
}

/// An input as the execution engine has it: the value, and the signal that says it is there.
template <typename Atomics>
struct Input final : BasicSignal<Atomics> {
  Input() : BasicSignal<Atomics>(read) {}

  static void read(BasicMessage<Atomics>& message) {
    auto& self = static_cast<Input&>(message);
    self.lower();
    self.latest.fetch();
    self.seen = self.latest.value();
  }

  Latest<model::Data<int>, Atomics> latest{0};
  int seen = 0;
};

/// The engine of an activity: sleeps, takes all messages, delivers them, until it has seen the last
/// value of every input.
template <typename Atomics>
model::Result check_engine(int inputs, int writes) {
  return model::explore([=](model::Program& program) {
    BasicWakeup<model::ParkerOf<Atomics>> wakeup;
    BasicInbox<Atomics> inbox;
    std::vector<std::unique_ptr<Input<Atomics>>> all;
    for (int i = 0; i < inputs; ++i) all.push_back(std::make_unique<Input<Atomics>>());
    for (auto& input : all) {
      program.thread("writer", [&] {
        for (int value = 1; value <= writes; ++value) {
          input->latest.write(value);
          if (input->raise(inbox)) wakeup.notify();
        }
      });
    }
    program.thread("engine", [&] {
      const auto complete = [&](const auto& input) { return input->seen == writes; };
      while (!std::all_of(all.begin(), all.end(), complete)) {
        wakeup.wait();
        auto* message = inbox.empty() ? nullptr : inbox.take_all();
        while (message != nullptr) {
          auto* const next = inbox.next(*message);
          message->deliver();
          message = next;
        }
      }
    });
    program.join();
  });
}

TEST(EngineModel, EveryValueWrittenIsSeenWithoutAnotherTrigger) {
  const model::Result one = check_engine<model::Atomics>(1, 3);
  EXPECT_EQ(one.failure, "");
  const model::Result two = check_engine<model::Atomics>(2, 1);
  EXPECT_EQ(two.failure, "");
  EXPECT_GT(std::min(one.executions, two.executions), 50u);
  RecordProperty("executions", static_cast<int>(one.executions + two.executions));
}

TEST(EngineModel, TheCheckFindsEachMistakeOfItsParts) {
  EXPECT_FALSE(check_engine<model::AtomicsWithoutRelease>(1, 2).ok());
  EXPECT_FALSE(check_engine<model::AtomicsWithoutAcquire>(1, 2).ok());
  EXPECT_FALSE(check_engine<model::AtomicsInTwoSteps>(1, 2).ok());
  EXPECT_FALSE(check_engine<model::AtomicsThatLookFirst>(1, 3).ok());
}

}  // namespace
}  // namespace armature::rt
