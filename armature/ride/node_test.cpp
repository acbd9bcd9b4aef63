// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/node.hpp"

#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/internal/node_rig.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(NodeTest, ExecutesTheGoldenBytesOfARequest) {
  auto raw = client();
  raw.send(bytes_of(
      "52494445 00000000 0200 2400 01000000 5879f122 09000000 01000000 02000000 03000000"));
  const auto reply = raw.receive();
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->header, (Header{0, Type::kReply, false, 20, 9}));
  EXPECT_EQ(hex(reply->body), "06000000");
}

TEST_F(NodeTest, TakesBytesAsTheyCome) {
  auto raw = client();
  for (const std::byte byte : bytes_of(
           "52494445 00000000 0200 2400 01000000 5879f122 09000000 01000000 02000000 03000000")) {
    raw.send({&byte, 1});
  }
  EXPECT_EQ(raw.receive_reply<std::int32_t>(9), 6);
}

TEST_F(NodeTest, ItsDirectoryFindsAndLists) {
  auto raw = client();
  raw.send({}, Type::kRequest, 0, internal::kFind, 1u, "camera");
  const auto found = raw.receive_reply<internal::ComponentEntry>(1);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->identifier, 1);
  EXPECT_EQ(found->name, "camera");
  EXPECT_EQ(found->interface, "Vision");
  EXPECT_EQ(found->digest, digest(kVision));
  raw.send({}, Type::kRequest, 0, internal::kFind, 2u, "lamp");
  EXPECT_EQ(raw.receive_reply<internal::ComponentEntry>(2)->identifier, 0);
  raw.send({}, Type::kRequest, 0, internal::kList, 3u);
  EXPECT_EQ(raw.receive_reply<std::vector<internal::ComponentEntry>>(3)->size(), 1u);
}

TEST_F(NodeTest, EveryFaultIsAnsweredByItsCode) {
  auto raw = client();
  raw.send({}, Type::kRequest, 9, kStart, 7u);
  auto refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kNoSuchComponent);
  EXPECT_EQ(refusal.call, 7u);
  EXPECT_EQ(refusal.type, 2u);
  EXPECT_EQ(refusal.recipient, 9u);
  EXPECT_EQ(refusal.operation, kStart);
  raw.send({}, Type::kCommand, 1, 0x12345678u);
  refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kNoSuchOperation);
  EXPECT_EQ(refusal.call, 0u);
  EXPECT_EQ(refusal.type, 1u);
  EXPECT_EQ(refusal.operation, 0x12345678u);
  raw.send({}, Type::kRequest, 1, kSetThreshold, 8u, std::uint8_t{1});
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed);
  raw.send({}, Type::kRequest, 1);
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed);
  raw.send({}, Type::kRequest, 0, internal::kFind, 8u, 5u);
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed);
  raw.send({}, Type::kRequest, 0, kStart, 8u);
  EXPECT_EQ(raw.receive_control().code, Code::kNoSuchOperation);
  raw.send({}, static_cast<Type>(6), 1, kStart);
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed);
  raw.send(bytes_of("52494445 00010000 0100 1400 01000000 ac56abdc"));
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed) << "priority 256";
  raw.send({}, Type::kEvent, 5, 1u);
  EXPECT_EQ(raw.receive_control().code, Code::kNoSuchComponent);
  raw.send({}, Type::kRequest, 1, kInitialize, 9u);
  refusal = raw.receive_control();
  EXPECT_EQ(refusal.code, Code::kFailed);
  EXPECT_EQ(refusal.text, "no lens");
  EXPECT_EQ(node_->statistics().refusals, 10u);
  EXPECT_THAT(log(), Contains(HasSubstr("was refused a REQUEST: NO_SUCH_COMPONENT")));
}

TEST_F(NodeTest, NoiseIsAnsweredOnceAndDisconnected) {
  auto raw = client();
  raw.send(bytes_of("474554202f20485454502f312e310d0a0d0a"));
  EXPECT_EQ(raw.receive_control().code, Code::kBadMagic);
  EXPECT_FALSE(raw.receive().has_value());
}

TEST_F(NodeTest, ALengthBelowTheHeadersIsTheEnd) {
  auto raw = client();
  raw.send(bytes_of("52494445 00000000 0100 0f00 01000000"));
  EXPECT_EQ(raw.receive_control().code, Code::kMalformed);
  EXPECT_FALSE(raw.receive().has_value());
}

TEST_F(NodeTest, HelloIsAnsweredByHelloAndPingByPong) {
  auto raw = client();
  raw.send({}, Type::kControl, 0, Control{Code::kHello, 0, 0, 0, "test 1"});
  EXPECT_EQ(raw.receive_control().code, Code::kHello);
  raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, "42"});
  const auto pong = raw.receive_control();
  EXPECT_EQ(pong.code, Code::kPong);
  EXPECT_EQ(pong.text, "42");
}

TEST_F(NodeTest, AnUnknownCodeIsLoggedAndIgnored) {
  auto raw = client();
  raw.send({}, Type::kControl, 0, Control{static_cast<Code>(99), 0, 0, 0, "new"});
  raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
  EXPECT_EQ(raw.receive_control().code, Code::kPong);
  EXPECT_THAT(log(), Contains(HasSubstr("unknown code 99: new")));
}

TEST_F(NodeTest, PendingMessagesAreDispatchedMostUrgentFirst) {
  auto raw = client();
  raw.send({}, Type::kCommand, 1, kStart);
  camera_.wait_until_started();
  Body batch;
  const auto add = [&](std::uint8_t level, std::int32_t what) {
    batch.append(RawClient::message({level}, Type::kCommand, 1, kNote, what).bytes());
  };
  add(0, 1);
  add(9, 2);
  add(9, 3);
  add(255, 4);
  add(64, 5);
  raw.send(batch.bytes());
  camera_.let_go();
  EXPECT_THAT(camera_.wait_for_notes(5), ElementsAre(4, 5, 2, 3, 1));
}

TEST_F(NodeTest, AContinuedRequestIsPutTogether) {
  auto raw = client();
  const std::string large(200'000, 'y');
  raw.send({}, Type::kRequest, 1, kEcho, 3u, large);
  EXPECT_EQ(raw.receive_reply<std::string>(3), large);
}

TEST_F(NodeTest, ASubscriptionIdentifierIsTakenOnce) {
  auto raw = client();
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  EXPECT_EQ(raw.subscribe(1, event, 5), 0);
  EXPECT_EQ(raw.subscribe(1, event, 5), 3);
}

TEST_F(NodeTest, AnEventHasItsGoldenBytes) {
  auto raw = client();
  ASSERT_EQ(raw.subscribe(1, event_number(static_cast<const ObjectPosition*>(nullptr)), 17), 0);
  camera_.raise({320, 240});
  const auto event = raw.receive();
  ASSERT_TRUE(event.has_value());
  EXPECT_EQ(event->header, (Header{0, Type::kEvent, false, 28, 17}));
  EXPECT_EQ(hex(event->body), "592b4c7140010000f0000000");
}

TEST_F(NodeTest, SaysThatItShutsDown) {
  auto raw = client();
  raw.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
  EXPECT_EQ(raw.receive_control().code, Code::kPong);
  node_.reset();
  EXPECT_EQ(raw.receive_control().code, Code::kShuttingDown);
  EXPECT_FALSE(raw.receive().has_value());
}

TEST_F(NodeTest, ARequestThatWaitsWhenItShutsDownIsTold) {
  auto raw = client();
  raw.send({}, Type::kCommand, 1, kStart);
  camera_.wait_until_started();
  raw.send({}, Type::kCommand, 1, kNote, 1);
  std::thread stopping([&] { node_.reset(); });
  camera_.let_go();
  stopping.join();
  EXPECT_EQ(raw.receive_control().code, Code::kShuttingDown);
}

TEST_F(NodeTest, ListensWhereNobodyElseReachesItOnly) {
  serve();
  const auto refused = node_->listen("tcp://0.0.0.0:0");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), HasSubstr("other machines would reach this address"));
  EXPECT_THAT(node_->listen("tcp://127.0.0.1:99999").error(), HasSubstr("port is not a number"));
  EXPECT_THAT(node_->listen("tls://127.0.0.1:1").error(), HasSubstr("has no transport 'tls'"));
}

TEST_F(NodeTest, ANameIsGivenOnceAndAnIdentifierNeverAgain) {
  serve();
  Camera other;
  const auto refused = node_->add("camera", other);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), HasSubstr("already hosts 'camera'"));
  node_->remove(camera_);
  EXPECT_EQ(node_->add("camera", other).value(), 2u);
  node_->remove(other);
}

TEST_F(NodeTest, ASubscriptionThatComesWithTheEndOfItsConnectionIsNone) {
  auto raw = std::optional(client());
  const Number event = event_number(static_cast<const ObjectPosition*>(nullptr));
  raw->send({}, Type::kCommand, 1, kStart);
  camera_.wait_until_started();
  Body batch;
  batch.append(RawClient::message({9}, Type::kCommand, 1, kNote, 1).bytes());
  batch.append(
      RawClient::message({}, Type::kRequest, 0, internal::kSubscribe, 1u, 1, event, 1).bytes());
  batch.append(bytes_of("47455420"));
  raw->send(batch.bytes());
  camera_.let_go();
  raw.reset();
  camera_.wait_for_notes(1);
  while (node_->statistics().connections != 0) std::this_thread::yield();
  camera_.raise({1, 2});  // The address sanitizer sees what is left of the connection.
  EXPECT_EQ(client().subscribe(1, event, 1), 0);
}

TEST_F(NodeTest, AServiceThatIsRemovedIsNoMore) {
  auto raw = client();
  ASSERT_EQ(raw.subscribe(1, event_number(static_cast<const ObjectPosition*>(nullptr)), 1), 0);
  node_->remove(camera_);
  camera_.raise({1, 2});
  raw.send({}, Type::kRequest, 1, kEcho, 4u, "?");
  EXPECT_EQ(raw.receive_control().code, Code::kNoSuchComponent) << "and no event before it";
}

}  // namespace
}  // namespace armature::ride
