// SPDX-License-Identifier: Apache-2.0
// When a thread is woken that another one sends something: for data once, when the hook or the
// handlers that wrote it have returned; for the rest at once.
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/rt/guard.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

class Sender : public Component {
 public:
  using Component::Component;
  OutputPort<int> first{this, "First", "a number"};
  OutputPort<int> second{this, "Second", "another"};
  Event<> happened{this, "happened", "something happened"};
};

class Receiver : public Component {
 public:
  using Component::Component;
  InputPort<int> first{this, "First", "a number", "", on_data<&Receiver::ignore>};
  InputPort<int> second{this, "Second", "another", "", on_data<&Receiver::ignore>};
  EventHandler<> handler{this, "happened", serve<&Receiver::on_happened>, "does nothing"};

 private:
  void ignore(const int&) {}
  void on_happened() {}
};

class WakeUp : public testing::Test {
 protected:
  WakeUp() : here_(sender_), there_(receiver_) {
    face(sender_.first).connect(face(receiver_.first), latest());
    face(sender_.second).connect(face(receiver_.second), latest());
    face(sender_.happened).subscribe(face(receiver_.handler));
    start(sender_, receiver_);
    there_.context.live = true;
    there_.context.wakes_on_messages = true;
  }

  void send_data() {
    sender_.first.write(1);
    sender_.second.write(2);
  }
  bool woken() { return there_.context.wakeup.try_wait(); }

  Sender sender_{"sender"};
  Receiver receiver_{"receiver"};
  TestThread here_;
  TestThread there_;
};

TEST_F(WakeUp, ComesAtOnceFromAThreadThatRunsNoComponents) {
  send_data();
  EXPECT_TRUE(woken());
}

TEST_F(WakeUp, ComesOnceForAllDataThatAHookWrites) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run(sender_, here_.context, [this] {
    send_data();
    EXPECT_FALSE(woken());
  });
  here_.context.outbox.flush();
  EXPECT_TRUE(woken());
  here_.context.outbox.flush();
  EXPECT_FALSE(woken());
}

TEST_F(WakeUp, ComesOnceForAllDataThatSeveralHandlersWrite) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run_handler(sender_, here_.context, [this] { send_data(); });
  Host::run_handler(sender_, here_.context, [this] { EXPECT_FALSE(woken()); });
  here_.context.outbox.flush();
  EXPECT_TRUE(woken());
}

TEST_F(WakeUp, ComesBeforeTheNextHookOrSentOperation) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run(sender_, here_.context, [this] { send_data(); });
  Host::run(sender_, here_.context, [this] { EXPECT_TRUE(woken()); });
}

TEST_F(WakeUp, OfAnEventComesWithinTheHook) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run(sender_, here_.context, [this] {
    sender_.happened.raise();
    EXPECT_TRUE(woken());
  });
}

TEST_F(WakeUp, ComesAtOnceWhereTheWriterMayWait) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run(sender_, here_.context, [this] {
    const rt::PermitScope waiting;
    send_data();
    EXPECT_TRUE(woken());
  });
}

TEST_F(WakeUp, ComesBeforeTheWriterWaits) {
  const rt::Outbox::Scope sending(here_.context.outbox);
  Host::run(sender_, here_.context, [this] {
    send_data();
    const rt::PermitScope waiting;
    EXPECT_TRUE(woken());
  });
}

}  // namespace
}  // namespace armature::component
