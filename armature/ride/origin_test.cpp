// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/origin.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <sys/socket.h>

#include "armature/ride/internal/raw_client.hpp"
#include "armature/ride/internal/test_vision.hpp"
#include "armature/ride/node.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;

/// Keeps by which connection each message came.
class Door final : public Service {
 public:
  Door() : Service(kVision) {}
  ~Door() override = default;

  Origin wait_for_origin() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, 20s, [&] { return origin_.has_value(); }));
    return *std::exchange(origin_, std::nullopt);
  }

 private:
  Executed execute(Number /*operation*/, Decoder& /*parameters*/, Reply& reply) override {
    const std::lock_guard lock(mutex_);
    origin_ = reply.origin();
    reply.done();
    changed_.notify_all();
    return Executed::kDone;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Origin> origin_;
};

class OriginTest : public testing::Test {
 protected:
  OriginTest() {
    address_ = node_.listen("tcp://127.0.0.1:0").value();
    EXPECT_TRUE(node_.add("door", door_).ok());
  }
  ~OriginTest() override { node_.remove(door_); }

  /// What a client has sent, as a command, which has no answer, or as a request.
  Origin origin_of(RawClient& client, Type type) {
    if (type == Type::kCommand) {
      client.send({}, type, 1, kStart);
    } else {
      client.send({}, type, 1, kStart, 7u);
    }
    return door_.wait_for_origin();
  }
  static bool becomes_lost(const Origin& origin) {
    for (int i = 0; i < 20'000 && !origin.lost(); ++i) std::this_thread::sleep_for(1ms);
    return origin.lost();
  }

  Door door_;
  Node node_;
  Address address_;
};

TEST_F(OriginTest, IsLostOnceItsClientHasGoneAndNotWithAnother) {
  for (const Type type : {Type::kCommand, Type::kRequest}) {
    auto one = std::make_optional<RawClient>(address_);
    RawClient another(address_);
    const Origin first = origin_of(*one, type);
    const Origin second = origin_of(another, type);
    EXPECT_FALSE(first.lost());
    EXPECT_EQ(first.who(), "local");
    one.reset();
    EXPECT_TRUE(becomes_lost(first));
    EXPECT_FALSE(second.lost());
  }
}

TEST_F(OriginTest, OfWhatNoPeerHasSentIsNeverLost) {
  EXPECT_FALSE(Origin().lost());
  EXPECT_FALSE(Lifeline(Origin()).lost(base::Time(24h)));
}

TEST_F(OriginTest, AClientThatIsSilentIsAskedAndLostAfterThreeTimesAsLong) {
  RawClient client(address_);
  Lifeline line(origin_of(client, Type::kCommand));
  const base::Time begin{1000s};
  EXPECT_FALSE(line.lost(begin));
  EXPECT_FALSE(line.lost(begin + 1s));
  EXPECT_EQ(client.receive_control().code, Code::kPing);
  EXPECT_FALSE(line.lost(begin + 2999ms));
  EXPECT_TRUE(line.lost(begin + 3s));
}

TEST_F(OriginTest, AClientThatAnswersIsNotLostHoweverLongItAsksNothing) {
  RawClient client(address_);
  Lifeline line(origin_of(client, Type::kCommand));
  base::Time now{1000s};
  EXPECT_FALSE(line.lost(now));
  for (int i = 0; i < 10; ++i) {
    now += 1s;
    EXPECT_FALSE(line.lost(now));
    ASSERT_EQ(client.receive_control().code, Code::kPing);
    const std::uint64_t before = node_.statistics().messages;
    client.send({}, Type::kControl, 0, Control{Code::kPong, 0, 0, 0, {}});
    while (node_.statistics().messages == before) std::this_thread::sleep_for(100us);
    EXPECT_FALSE(line.lost(now)) << "which it has heard now";
  }
}

TEST_F(OriginTest, AClientThatOnlySaysThatItSendsNoMoreIsLost) {
  RawClient client(address_);
  const Origin origin = origin_of(client, Type::kCommand);
  ASSERT_EQ(::shutdown(client.handle(), SHUT_WR), 0);
  EXPECT_TRUE(becomes_lost(origin));
}

TEST_F(OriginTest, EqualsThoseOfTheSameConnectionOnly) {
  RawClient one(address_);
  RawClient other(address_);
  const Origin first = origin_of(one, Type::kCommand);
  EXPECT_TRUE(first == origin_of(one, Type::kCommand));
  EXPECT_FALSE(first == origin_of(other, Type::kCommand));
  EXPECT_FALSE(first == Origin());
  EXPECT_TRUE(Origin() == Origin());
}

}  // namespace
}  // namespace armature::ride
