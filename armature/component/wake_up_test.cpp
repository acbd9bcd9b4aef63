// SPDX-License-Identifier: Apache-2.0
// When a thread is woken that another one sends something.
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/component/internal/test_thread.hpp"

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
    sender_.first.connect(receiver_.first, latest());
    sender_.second.connect(receiver_.second, latest());
    sender_.happened.subscribe(receiver_.handler);
    start(sender_, receiver_);
    there_.context.live = true;
    there_.context.wakes_on_messages = true;
  }

  void send_all() {
    sender_.first.write(1);
    sender_.second.write(2);
    sender_.happened.raise();
  }
  bool woken() { return there_.context.wakeup.try_wait(); }

  Sender sender_{"sender"};
  Receiver receiver_{"receiver"};
  TestThread here_;
  TestThread there_;
};

TEST_F(WakeUp, ComesAtOnceFromAThreadThatRunsNoComponents) {
  send_all();
  EXPECT_TRUE(woken());
}

TEST_F(WakeUp, ComesOnceForAllThatAHookSends) {
  const rt::OwedWakeups::Account account(here_.context.owed);
  sender_.run(here_.context, [this] {
    send_all();
    EXPECT_FALSE(woken());
  });
  here_.context.owed.pay();
  EXPECT_TRUE(woken());
  here_.context.owed.pay();
  EXPECT_FALSE(woken());
}

TEST_F(WakeUp, ComesOnceForAllThatSeveralHandlersSend) {
  const rt::OwedWakeups::Account account(here_.context.owed);
  sender_.run_handler(here_.context, [this] { send_all(); });
  sender_.run_handler(here_.context, [this] { EXPECT_FALSE(woken()); });
  here_.context.owed.pay();
  EXPECT_TRUE(woken());
}

TEST_F(WakeUp, ComesBeforeTheNextHookOrOperation) {
  const rt::OwedWakeups::Account account(here_.context.owed);
  sender_.run(here_.context, [this] { send_all(); });
  sender_.run(here_.context, [this] { EXPECT_TRUE(woken()); });
}

TEST_F(WakeUp, ComesBeforeTheSenderWaits) {
  const rt::OwedWakeups::Account account(here_.context.owed);
  sender_.run(here_.context, [this] {
    send_all();
    const rt::PermitScope waiting;
    EXPECT_TRUE(woken());
  });
}

}  // namespace
}  // namespace armature::component
