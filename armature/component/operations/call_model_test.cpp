// SPDX-License-Identifier: Apache-2.0
// All interleavings of a call or command with its cancellation, its result and its memory.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/operations/call_record.hpp"
#include "armature/component/operations/command_ticket.hpp"
#include "armature/testing/model/explore.hpp"
#include "armature/testing/model/mutants.hpp"

namespace armature::component {
namespace {

namespace model = testing::model;
using ::testing::HasSubstr;
using Value = model::Data<int>;

/// Of one record: its memory, which is written when the record is freed, and what was done with it.
struct Trace {
  Value memory = 0;
  int freed = 0;
  int executed = 0;
};

/// A call of `value + 100`, executed by whoever delivers it.
template <typename Atomics>
struct Call final : BasicCallRecord<Value, model::ParkerOf<Atomics>> {
  using Record = BasicCallRecord<Value, model::ParkerOf<Atomics>>;

  explicit Call(Trace& its_trace) : Record(&Call::deliver), trace(its_trace) {}
  void dispose() override {
    trace.memory = -1;
    ++trace.freed;
  }
  static void deliver(rt::BasicMessage<Atomics>& message) {
    auto& call = static_cast<Call&>(message);
    Trace& trace = call.trace;
    if (!call.try_begin()) return;
    ++trace.executed;
    trace.memory = trace.memory;
    CallResult<Value> result{CallStatus::kDone};
    result.value = call.argument + 100;
    call.finish(std::move(result));
  }

  Value argument = 0;
  Trace& trace;
};

/// Calls twice through the same record, if it is free again, looking for the result or cancelling,
/// and lets go of the record at the end, with a call perhaps under way.
template <typename Atomics>
model::Result check_calls(bool cancels) {
  return model::explore([cancels](model::Program& program) {
    rt::BasicInbox<Atomics> inbox;
    Trace trace;
    Call<Atomics> call(trace);
    int sent = 0;
    int cancelled = 0;
    program.thread("caller", [&] {
      for (int value = 1; value <= 2; ++value) {
        if (!call.try_claim()) break;
        call.argument = value;
        inbox.push(call);
        ++sent;
        if (cancels && call.try_cancel()) ++cancelled;
        if (call.finished() && !call.cancelled()) {
          program.expect(call.result().value == value + 100, "the result is another call's");
        }
        call.release();  // the handle's
      }
      call.release();  // the pool's
    });
    program.thread("executor", [&] { inbox.deliver_all(); });
    program.join();
    inbox.deliver_all();
    program.expect(trace.executed + cancelled == sent,
                   "a call was executed and cancelled, or neither");
    program.expect(trace.freed == 1, "the record was freed twice or never");
  });
}

TEST(CallModel, ACallIsExecutedOrCancelledAndItsRecordIsFreedOnce) {
  const model::Result looking = check_calls<model::Atomics>(false);
  EXPECT_EQ(looking.failure, "");
  const model::Result cancelling = check_calls<model::Atomics>(true);
  EXPECT_EQ(cancelling.failure, "");
  EXPECT_GT(looking.executions + cancelling.executions, 50u);
  RecordProperty("executions", static_cast<int>(looking.executions + cancelling.executions));
}

TEST(CallModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_calls<model::AtomicsWithoutRelease>(false).failure, HasSubstr("data race"));
  EXPECT_THAT(check_calls<model::AtomicsWithoutAcquire>(false).failure, HasSubstr("data race"));
}

TEST(CallModel, TheCheckFindsACancellationInTwoSteps) {
  EXPECT_FALSE(check_calls<model::AtomicsInTwoSteps>(true).ok());
}

/// Waits for the result, however long the executor takes; or gives up at any moment.
template <typename Atomics>
model::Result check_waiting() {
  return model::explore([](model::Program& program) {
    rt::BasicInbox<Atomics> inbox;
    Trace trace;
    Call<Atomics> call(trace);
    static_cast<void>(call.try_claim());
    call.argument = 1;
    inbox.push(call);
    program.thread("caller", [&] {
      call.wait_until(base::Time{});
      if (call.finished()) {
        program.expect(call.result().value == 101, "finished without a result");
      }
    });
    program.thread("executor", [&] { inbox.deliver_all(); });
    program.join();
  });
}

TEST(CallModel, WhoSeesACallFinishedSeesItsResult) {
  EXPECT_EQ(check_waiting<model::Atomics>().failure, "");
  EXPECT_THAT(check_waiting<model::AtomicsWithoutRelease>().failure, HasSubstr("data race"));
  EXPECT_THAT(check_waiting<model::AtomicsWithoutAcquire>().failure, HasSubstr("data race"));
}

/// A command that ends by itself, beside a sender that cancels it twice and reads why it ended.
template <typename Atomics>
struct Ticket final : rt::BasicMessage<Atomics>, BasicCommandState<Value, Atomics> {
  struct Cancellation final : rt::BasicMessage<Atomics> {
    explicit Cancellation(Ticket& its_ticket)
        : rt::BasicMessage<Atomics>(&Cancellation::deliver), ticket(its_ticket) {}
    static void deliver(rt::BasicMessage<Atomics>& message) {
      Ticket& ticket = static_cast<Cancellation&>(message).ticket;
      ++ticket.told;
      if (ticket.under_way) ticket.finish(CommandStage::kCancelled, 2);
      ticket.release();
    }
    Ticket& ticket;
  };

  explicit Ticket(Trace& its_trace)
      : rt::BasicMessage<Atomics>(&Ticket::deliver), trace(its_trace) {}
  void dispose() override {
    trace.memory = -1;
    ++trace.freed;
    trace.executed = told;
  }
  static void deliver(rt::BasicMessage<Atomics>& message) {
    auto& ticket = static_cast<Ticket&>(message);
    ticket.under_way = true;
    ticket.accept();
  }
  /// What the component does when the command is over.
  void finish(CommandStage stage, int why) {
    under_way = false;
    this->end(stage, Value(why));
  }

  Trace& trace;
  bool under_way = false;
  int told = 0;
  Cancellation cancellation{*this};
};

template <typename Atomics>
model::Result check_command() {
  return model::explore([](model::Program& program) {
    rt::BasicInbox<Atomics> inbox;
    Trace trace;
    Ticket<Atomics> ticket(trace);
    static_cast<void>(ticket.try_claim());
    ticket.release();  // the pool's: its owner is gone
    inbox.push(ticket);
    program.thread("sender", [&] {
      for (int i = 0; i < 2; ++i) {
        if (ticket.want_cancel()) inbox.push(ticket.cancellation);
      }
      if (ticket.ended()) {
        const int why = ticket.given_reason();
        program.expect(why == (ticket.stage() == CommandStage::kDone ? 1 : 2), "another reason");
      }
      ticket.release();
    });
    program.thread("executor", [&] {
      inbox.deliver_all();
      if (ticket.under_way) ticket.finish(CommandStage::kDone, 1);
    });
    program.join();
    inbox.deliver_all();
    program.expect(trace.freed == 1, "the ticket was freed twice or never");
    program.expect(trace.executed == 1, "the wish to cancel was told twice or never");
  });
}

TEST(CommandModel, ItEndsOnceWithItsReasonAndItsTicketIsFreedOnce) {
  const model::Result result = check_command<model::Atomics>();
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.executions, 20u);
  RecordProperty("executions", static_cast<int>(result.executions));
}

TEST(CommandModel, TheCheckFindsMissingMemoryOrders) {
  EXPECT_THAT(check_command<model::AtomicsWithoutRelease>().failure, HasSubstr("data race"));
  EXPECT_THAT(check_command<model::AtomicsWithoutAcquire>().failure, HasSubstr("data race"));
}

}  // namespace
}  // namespace armature::component
