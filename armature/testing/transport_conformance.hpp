// SPDX-License-Identifier: Apache-2.0
#pragma once

// What every transport has to do: a test instantiates the suite with a function that makes one.
// There are no clocks in it: what cannot be done yet is waited for with a poller.

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {

/// A transport under test.
struct TransportCase {
  std::string name;
  std::function<std::unique_ptr<Transport>()> make;
  std::function<Address()> address;  ///< one that nobody listens at
};

/// The contract of a `Transport`, to be instantiated for each one.
class TransportConformance : public testing::TestWithParam<TransportCase> {
 protected:
  TransportConformance() {
    auto listener = transport_->listen(GetParam().address());
    EXPECT_TRUE(listener.ok()) << (listener ? "" : listener.error());
    if (listener) listener_ = std::move(listener).value();
  }

  static void wait_for(int handle, Progress wanted) {
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(handle, 0, {wanted == Progress::kWantRead, wanted == Progress::kWantWrite});
    while (poller->wait(base::Duration::max()).empty()) {
    }
  }

  /// Two connected ends.
  void connect() {
    auto connecting = transport_->connect(listener_->address());
    ASSERT_TRUE(connecting.ok()) << connecting.error();
    near_ = std::move(connecting).value();
    bool near_is_up = false;
    bool far_is_up = false;
    while ((far_ = listener_->accept()) == nullptr) ASSERT_NO_FATAL_FAILURE(knock(near_is_up));
    while (!near_is_up || !far_is_up) {
      near_is_up = near_is_up || establish(*near_, far_is_up);
      far_is_up = far_is_up || establish(*far_, near_is_up);
    }
  }

  /// Has the near end go on, and waits for either: some listeners accept nobody who has not said
  /// what he wants.
  void knock(bool& near_is_up) {
    const Progress progress = near_is_up ? Progress::kDone : near_->establish();
    ASSERT_NE(progress, Progress::kGone) << near_->problem();
    near_is_up = progress == Progress::kDone;
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(listener_->handle(), 0, {true, false});
    if (!near_is_up) {
      poller->add(near_->handle(), 1,
                  {progress == Progress::kWantRead, progress == Progress::kWantWrite});
    }
    while (poller->wait(base::Duration::max()).empty()) {
    }
  }

  /// Waits only when the other end has nothing left to do.
  static bool establish(Connection& end, bool wait) {
    const Progress progress = end.establish();
    EXPECT_NE(progress, Progress::kGone) << end.problem();
    if (wait && progress != Progress::kDone) wait_for(end.handle(), progress);
    return progress == Progress::kDone;
  }

  static void send_all(Connection& end, const std::vector<std::byte>& bytes) {
    std::span<const std::byte> left(bytes);
    while (!left.empty()) {
      std::size_t sent = 0;
      const Progress progress = end.send(left, sent);
      ASSERT_NE(progress, Progress::kGone) << end.problem();
      if (progress == Progress::kDone) {
        left = left.subspan(sent);
      } else {
        wait_for(end.handle(), progress);
      }
    }
  }

  static std::vector<std::byte> receive(Connection& end, std::size_t count) {
    std::vector<std::byte> all;
    std::vector<std::byte> room(1 << 16);
    while (all.size() < count) {
      std::size_t size = 0;
      const Progress progress = end.receive(room, size);
      if (progress == Progress::kGone) break;
      if (progress == Progress::kDone) {
        all.insert(all.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(size));
      } else {
        wait_for(end.handle(), progress);
      }
    }
    return all;
  }

  static std::vector<std::byte> pattern(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 % 253);
    return bytes;
  }

  std::unique_ptr<Transport> transport_ = GetParam().make();
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Connection> near_;
  std::unique_ptr<Connection> far_;
};

TEST_P(TransportConformance, NobodyWaitsAtFirst) { EXPECT_EQ(listener_->accept(), nullptr); }

TEST_P(TransportConformance, BytesArriveInTheirOrderBothWays) {
  ASSERT_NO_FATAL_FAILURE(connect());
  send_all(*near_, pattern(1000));
  EXPECT_EQ(receive(*far_, 1000), pattern(1000));
  send_all(*far_, pattern(77));
  EXPECT_EQ(receive(*near_, 77), pattern(77));
}

TEST_P(TransportConformance, AReceiverThatIsSlowHoldsUpTheSenderAndLosesNothing) {
  ASSERT_NO_FATAL_FAILURE(connect());
  const auto much = pattern(16 << 20);
  std::vector<std::byte> received;
  std::thread receiver([&] { received = receive(*far_, much.size()); });
  send_all(*near_, much);
  receiver.join();
  EXPECT_TRUE(received == much);
}

TEST_P(TransportConformance, ReceivingNothingSaysSo) {
  ASSERT_NO_FATAL_FAILURE(connect());
  std::byte room[8];
  std::size_t size = 0;
  EXPECT_EQ(near_->receive(room, size), Progress::kWantRead);
}

TEST_P(TransportConformance, WaitingForBytesEndsWithTheLimit) {
  ASSERT_NO_FATAL_FAILURE(connect());
  std::byte room[8];
  std::size_t size = 0;
  EXPECT_EQ(near_->wait_and_receive(room, size, std::chrono::milliseconds(1)), Progress::kWantRead);
  EXPECT_EQ(near_->wait_and_receive(room, size, std::chrono::nanoseconds(1)), Progress::kWantRead);
  send_all(*far_, pattern(3));
  EXPECT_EQ(near_->wait_and_receive(room, size, std::chrono::hours(1)), Progress::kDone);
  EXPECT_EQ(size, 3u);
}

TEST_P(TransportConformance, TheEndOfOneSideIsSeenByTheOtherBehindItsBytes) {
  ASSERT_NO_FATAL_FAILURE(connect());
  send_all(*near_, pattern(5));
  near_.reset();
  EXPECT_EQ(receive(*far_, 6), pattern(5));
  std::byte room[8];
  std::size_t size = 0;
  EXPECT_EQ(far_->wait_and_receive(room, size, std::chrono::hours(1)), Progress::kGone);
  EXPECT_FALSE(far_->problem().empty());
}

TEST_P(TransportConformance, ShuttingDownEndsWhoeverWaits) {
  ASSERT_NO_FATAL_FAILURE(connect());
  Progress progress = Progress::kDone;
  std::thread waiter([&] {
    std::byte room[8];
    std::size_t size = 0;
    progress = near_->wait_and_receive(room, size, std::chrono::hours(1));
  });
  near_->shut_down();
  waiter.join();
  EXPECT_EQ(progress, Progress::kGone);
}

TEST_P(TransportConformance, ConnectingToNobodyFails) {
  const Address address = listener_->address();
  listener_.reset();
  auto connecting = transport_->connect(address);
  if (!connecting) {
    EXPECT_NE(connecting.error().find(address.host), std::string::npos) << connecting.error();
    return;
  }
  Progress progress = Progress::kWantWrite;
  while (progress != Progress::kGone) {
    progress = connecting.value()->establish();
    ASSERT_NE(progress, Progress::kDone);
    if (progress != Progress::kGone) wait_for(connecting.value()->handle(), progress);
  }
  EXPECT_FALSE(connecting.value()->problem().empty());
}

TEST_P(TransportConformance, TwoCannotListenAtOneAddress) {
  const auto second = transport_->listen(listener_->address());
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().find(listener_->address().host), std::string::npos) << second.error();
}

TEST_P(TransportConformance, AnAddressIsFreeAgainOnceNobodyListens) {
  const Address address = listener_->address();
  listener_.reset();
  EXPECT_TRUE(transport_->listen(address).ok());
}

}  // namespace armature::ride
