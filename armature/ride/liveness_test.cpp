// SPDX-License-Identifier: Apache-2.0
// When a peer that says nothing is lost.
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"
#include "armature/ride/internal/raw_client.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A peer of a node that the test drives, and what is at its other end; the clock is the test's.
class Liveness : public testing::Test {
 protected:
  Liveness() {
    const auto transport = state_.find_transport("tcp");
    const auto listener = std::move(transport->listen({"tcp", "127.0.0.1", 0})).value();
    peer_ = std::make_shared<internal::PeerState>(state_, listener->address().text());
    peer_->start(transport, listener->address());
    std::unique_ptr<Connection> accepted;
    while (!accepted) accepted = listener->accept();
    other_.emplace(std::move(accepted));
    while (!peer_->link().open()) state_.step(1ms);
    begun_ = platform::monotonic_now();
    EXPECT_EQ(other_->receive_control().code, Code::kHello);
    EXPECT_EQ(other_->receive()->header.type, Type::kRequest) << "whether it is there";
  }

  /// What is open fails, and is let go of, as when a node ends.
  ~Liveness() override { peer_->link().break_off("the test is over"); }

  /// What it does when so much time has passed.
  void look_after(base::Duration time) { peer_->look_at_timers(begun_ + time); }
  void expect_question() { EXPECT_EQ(other_->receive_control().code, Code::kPing); }
  /// Until the node has taken what the other side has sent.
  void take() {
    const auto before = peer_->link().signs_of_life();
    while (peer_->link().signs_of_life() == before) state_.step(1ms);
  }
  std::string problem() { return peer_->link().problem(); }

  internal::NodeState state_{NodeOptions{}};
  std::shared_ptr<internal::PeerState> peer_;
  std::optional<RawClient> other_;
  base::Time begun_{};
};

TEST_F(Liveness, ASilentPeerIsLostAfterItWasAskedTwice) {
  look_after(1010ms);
  expect_question();
  look_after(1500ms);
  look_after(2020ms);
  expect_question();
  look_after(2900ms);
  EXPECT_EQ(problem(), "");
  look_after(3030ms);
  EXPECT_THAT(problem(), HasSubstr("it was silent for three times as long as allowed"));
}

TEST_F(Liveness, WhoStoodStillItselfAsksFirst) {
  look_after(10s);
  expect_question();
  EXPECT_EQ(problem(), "");
  look_after(11s);
  expect_question();
  EXPECT_EQ(problem(), "");
  other_->send({}, Type::kControl, 0, Control{Code::kPong, 0, 0, 0, ""});
  take();
  look_after(12s);
  EXPECT_EQ(problem(), "");
  look_after(22s);
  expect_question();
  EXPECT_EQ(problem(), "");
}

TEST_F(Liveness, PartsOfAMessageAreSignsOfLife) {
  const std::string large(600'000, 'x');
  const Body event = RawClient::message({}, Type::kEvent, 1, 7u, large);
  for (int part = 0; part < 8; ++part) {
    other_->send(event.bytes().subspan(static_cast<std::size_t>(part) * Header::kMostLength,
                                       Header::kMostLength));
    take();
    look_after((part + 1) * 900ms);
    EXPECT_EQ(problem(), "");
  }
  look_after(9s);
  expect_question();
}

}  // namespace
}  // namespace armature::ride
