// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/messages.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"

namespace armature::websocket::internal {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint8_t kContinued = 0;
constexpr std::uint8_t kTextFrame = 1;
constexpr std::uint8_t kBinaryFrame = 2;

class Correspondence : public ::testing::Test {
 protected:
  Correspondence() {
    messages_ = std::make_shared<Messages>(Messages::Options{.subprotocol = "talk.v1",
                                                             .path = "/talk/",
                                                             .identity = "talker",
                                                             .clients = 3,
                                                             .message_bytes = 1000,
                                                             .asked = 4,
                                                             .queue_bytes = 100'000,
                                                             .most_bytes = 200'000});
    Options options;
    options.messages = messages_;
    server_ =
        Server::listen({"ws", "127.0.0.1", 0}, options, Pages::in(site_.folder()).value()).value();
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(server_->address().port); }
  /// With its secret.
  std::string path() const {
    const std::string address = messages_->addresses().at(0);
    return address.substr(address.find("/talk/"));
  }
  std::string request(const std::string& path, const std::string& host,
                      const std::string& protocol = "talk.v1") const {
    return "GET " + path + " HTTP/1.1\r\nHost: " + host +
           "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nOrigin: https://elsewhere.example\r\n"
           "Sec-WebSocket-Protocol: " +
           protocol +
           "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
  }
  std::string answer_to(const std::string& request) const {
    RawVisitor visitor(server_->address().port);
    EXPECT_TRUE(visitor.send(request));
    return visitor.read_to_end();
  }
  std::unique_ptr<RawVisitor> client() {
    auto visitor = std::make_unique<RawVisitor>(server_->address().port);
    EXPECT_TRUE(visitor->send(request(path(), host())));
    std::string head;
    while (!head.ends_with("\r\n\r\n")) head += bytes_of(*visitor, 1);
    EXPECT_THAT(head, StartsWith("HTTP/1.1 101"));
    EXPECT_THAT(head, HasSubstr("talk.v1"));
    return visitor;
  }
  /// The next ones, as soon as there are so many.
  std::vector<Incoming> taken(std::size_t count) {
    std::vector<Incoming> all;
    while (all.size() < count) {
      auto more = messages_->take(kPatience);
      if (more.empty()) break;
      std::ranges::move(more, std::back_inserter(all));
    }
    return all;
  }
  static std::string bytes_of(RawVisitor& visitor, std::size_t count) {
    std::string all;
    std::vector<std::byte> room(count);
    while (all.size() < count) {
      std::size_t size = 0;
      const auto status = visitor.socket().wait_and_receive(
          std::span(room).first(count - all.size()), size, kPatience);
      if (status != platform::StreamStatus::kDone) break;
      all.append(reinterpret_cast<const char*>(room.data()), size);
    }
    return all;
  }
  /// The payload of the next frame, of less than 64 kB.
  static std::string message_to(RawVisitor& visitor) {
    const std::string head = bytes_of(visitor, 2);
    if (head.size() < 2) return {};
    std::size_t size = static_cast<unsigned char>(head[1]);
    if (size == 126) {
      const std::string more = bytes_of(visitor, 2);
      size = static_cast<unsigned char>(more[0]) * 256U + static_cast<unsigned char>(more[1]);
    }
    return bytes_of(visitor, size);
  }

  Site site_;
  std::shared_ptr<Messages> messages_;
  std::unique_ptr<Server> server_;
};

TEST_F(Correspondence, OnlyWhoKnowsTheSecretComesIn) {
  const std::string wrong = path().substr(0, path().size() - 1) + "x";
  for (const std::string& bad :
       {request("/", host()), request("/talk/", host()), request(wrong, host()),
        request("/talk/" + server_->entry().token(), host()), request(path() + "0", host()),
        request(path(), "evil.example"), request(path(), host(), "ride")}) {
    EXPECT_THAT(answer_to(bad), HasSubstr(" 403 ")) << bad;
  }
  EXPECT_TRUE(messages_->take(base::Duration(0)).empty());
  const auto good = client();
  EXPECT_EQ(taken(1).at(0).kind, Incoming::Kind::kCame);
}

TEST_F(Correspondence, MessagesComeWholeHoweverTheyAreCut) {
  const auto visitor = client();
  std::string first = frame(kTextFrame, "one ");
  first[0] = static_cast<char>(kTextFrame);  // more follows
  visitor->send(first + frame(kContinued, "message") + frame(kBinaryFrame, "another"));
  const auto came = taken(3);
  ASSERT_EQ(came.size(), 3u);
  EXPECT_EQ(came[1].kind, Incoming::Kind::kText);
  EXPECT_EQ(came[1].content, "one message");
  EXPECT_EQ(came[2].kind, Incoming::Kind::kBinary);
  EXPECT_EQ(came[2].content, "another");

  const std::uint32_t number = came[0].client;
  messages_->send(number, "text");
  EXPECT_TRUE(messages_->offer(number, std::string(40'000, 'v')));
  EXPECT_EQ(message_to(*visitor), "text");
  EXPECT_EQ(message_to(*visitor), std::string(40'000, 'v'));
}

TEST_F(Correspondence, EachHasAConnectionToTheNodeWithTheIdentity) {
  const auto visitor = client();
  const auto came = taken(1);
  ASSERT_NE(came.at(0).inside, nullptr);
  const auto outer = server_->accept();
  ASSERT_NE(outer, nullptr);
  EXPECT_EQ(outer->identity(), "talker");
  const std::string asked = "asked";
  std::size_t size = 0;
  EXPECT_EQ(came[0].inside->send(std::as_bytes(std::span(asked)), size), ride::Progress::kDone);
  std::array<std::byte, 16> room{};
  EXPECT_EQ(outer->wait_and_receive(room, size, kPatience), ride::Progress::kDone);
  EXPECT_EQ(size, asked.size());
}

TEST_F(Correspondence, WhoLeavesIsTold) {
  client().reset();
  const auto came = taken(2);
  ASSERT_EQ(came.size(), 2u);
  EXPECT_EQ(came[1].kind, Incoming::Kind::kGone);
  EXPECT_FALSE(messages_->offer(came[1].client, "late"));
}

TEST_F(Correspondence, AMessageThatIsTooLargeEndsTheConnection) {
  const auto in_one = client();
  in_one->send(frame(kTextFrame, "x", 1001));
  const auto in_two = client();
  std::string first = frame(kTextFrame, std::string(600, 'x'));
  first[0] = static_cast<char>(kTextFrame);
  in_two->send(first + frame(kContinued, std::string(600, 'x')));
  EXPECT_THAT(in_one->read_to_end(), HasSubstr("a message is too large"));
  EXPECT_THAT(in_two->read_to_end(), HasSubstr("a message is too large"));
  for (const Incoming& one : taken(4)) {
    EXPECT_NE(one.kind, Incoming::Kind::kText) << one.content;
  }
}

TEST_F(Correspondence, WhoAsksFasterThanItIsAnsweredIsReadFromNoFurther) {
  const auto visitor = client();
  constexpr std::size_t kMany = 1000;
  std::string all;
  for (std::size_t i = 0; i < kMany; ++i) all += frame(kTextFrame, "ask");
  visitor->send(all);
  std::size_t came = 0;
  std::size_t most = 0;
  while (came < kMany + 1) {
    const std::size_t now = messages_->take(kPatience).size();
    ASSERT_GT(now, 0u);
    came += now;
    most = std::max(most, now);
  }
  EXPECT_EQ(came, kMany + 1);
  // A piece that the library has read already is handed over to its end.
  EXPECT_LT(most, kMany / 2);
}

TEST_F(Correspondence, WhoReadsNothingLosesValuesAndAnotherGetsAll) {
  const auto slow = client();
  const std::uint32_t slow_number = taken(1).at(0).client;
  const auto quick = client();
  const std::uint32_t quick_number = taken(1).at(0).client;
  constexpr int kMany = 2000;
  const std::string value(10'000, 'v');  // 20 MB, more than the system holds for a connection
  int lost = 0;
  for (int i = 0; i < kMany; ++i) {
    lost += messages_->offer(slow_number, value) ? 0 : 1;
    ASSERT_TRUE(messages_->offer(quick_number, value)) << i;
    ASSERT_EQ(message_to(*quick).size(), value.size()) << i;
  }
  EXPECT_GT(lost, kMany / 4);
  EXPECT_LT(lost, kMany);
}

TEST_F(Correspondence, WhoTakesNothingOfWhatMustNotBeLostIsDisconnected) {
  const auto slow = client();
  const std::uint32_t number = taken(1).at(0).client;
  for (int i = 0; i < 2000; ++i) messages_->send(number, std::string(10'000, 'm'));
  const auto came = taken(1);
  ASSERT_EQ(came.size(), 1u);
  EXPECT_EQ(came[0].kind, Incoming::Kind::kGone);
}

TEST_F(Correspondence, OneMoreThanThereIsRoomForIsSentAway) {
  const std::vector<std::unique_ptr<RawVisitor>> all = [&] {
    std::vector<std::unique_ptr<RawVisitor>> three;
    for (int i = 0; i < 3; ++i) three.push_back(client());
    return three;
  }();
  EXPECT_EQ(taken(3).size(), 3u);
  RawVisitor fourth(server_->address().port);
  fourth.send(request(path(), host()));
  fourth.read_to_end();
  EXPECT_TRUE(fourth.ended());
  messages_->send(1, "still there");
  EXPECT_EQ(message_to(*all[0]), "still there");
}

}  // namespace
}  // namespace armature::websocket::internal
