// SPDX-License-Identifier: Apache-2.0
// What a component sends to another thread arrives there in the order in which it was sent.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/component/internal/test_ports.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

class Sender : public Component {
 public:
  using Component::Component;
  OutputPort<int> data{this, "Data", "numbers"};
  Event<int> happened{this, "happened", "something happened", {"count"}};
};

class Receiver : public Component {
 public:
  using Component::Component;
  InputPort<int> data{this, "Data", "numbers", "", on_data<&Receiver::on_data_>};
  EventHandler<int> handler{this, "happened", serve<&Receiver::on_happened>, "notes it"};
  std::vector<std::string> order;
  std::function<void()> then;

 private:
  void on_data_(const int& value) { note("data " + std::to_string(value)); }
  void on_happened(int count) { note("event " + std::to_string(count)); }
  void note(const std::string& what) {
    order.push_back(what);
    if (const auto action = std::exchange(then, nullptr)) action();
  }
};

struct Way {
  const char* name;
  ConnectionPolicy policy;
  bool in_batches;
};

class MessageOrder : public testing::TestWithParam<Way> {
 protected:
  MessageOrder() : here_(sender_), there_(receiver_) {
    face(sender_.data).connect(face(receiver_.data), GetParam().policy);
    face(sender_.happened).subscribe(face(receiver_.handler));
    start(sender_, receiver_);
    there_.context.live = true;
    here_.prepare_lanes();
    if (GetParam().in_batches) sending_.emplace(here_.context.outbox);
  }
  void deliver() {
    do {
      here_.context.outbox.flush();
      there_.deliver();
    } while (here_.context.outbox.any());
  }
  Sender sender_{"sender"};
  Receiver receiver_{"receiver"};
  TestThread here_;
  TestThread there_;
  std::optional<rt::Outbox::Scope> sending_;
};

TEST_P(MessageOrder, EventsKeepTheirPlaceAmongData) {
  sender_.happened.raise(1);
  sender_.data.write(10);
  sender_.happened.raise(2);
  deliver();
  EXPECT_THAT(receiver_.order, ElementsAre("event 1", "data 10", "event 2"));
}

TEST_P(MessageOrder, WhatIsWrittenDuringADeliveryDoesNotOvertakeAnEventBeforeIt) {
  receiver_.then = [this] {  // what the sender's thread does meanwhile
    sender_.happened.raise(1);
    sender_.data.write(2);
  };
  sender_.data.write(1);
  deliver();
  EXPECT_THAT(receiver_.order, ElementsAre("data 1", "event 1", "data 2"));
}

TEST_P(MessageOrder, AnEventRaisedDuringADeliveryDoesNotOvertakeDataBeforeIt) {
  receiver_.then = [this] {
    sender_.data.write(1);
    sender_.happened.raise(2);
  };
  sender_.happened.raise(1);
  deliver();
  EXPECT_THAT(receiver_.order, ElementsAre("event 1", "data 1", "event 2"));
}

INSTANTIATE_TEST_SUITE_P(Policies, MessageOrder,
                         testing::Values(Way{"Latest", latest(), false},
                                         Way{"InBatches", latest(), true},
                                         Way{"Fifo", fifo(4), true}),
                         [](const auto& way) { return way.param.name; });

TEST(MessageOrderOfFifos, AllThatWasWrittenBeforeTheDeliveryComesWithIt) {
  Sender sender("sender");
  Receiver receiver("receiver");
  TestThread here(sender);
  TestThread there(receiver);
  face(sender.data).connect(face(receiver.data), fifo(2, rt::WhenFull::kDropOldest));
  face(sender.happened).subscribe(face(receiver.handler));
  start(sender, receiver);
  for (int value = 1; value <= 3; ++value) sender.data.write(value);
  sender.happened.raise(1);
  there.deliver();
  EXPECT_THAT(receiver.order, ElementsAre("data 2", "data 3", "event 1"));
}

}  // namespace
}  // namespace armature::component
