// SPDX-License-Identifier: Apache-2.0
// Whatever comes to the open port of a node that serves pages.
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"

namespace armature::websocket::internal {
namespace {

using platform::StreamStatus;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::uint8_t kText = 1;
constexpr std::uint8_t kBinary = 2;
constexpr std::uint8_t kPing = 9;

class HostileVisitor : public ::testing::Test {
 protected:
  explicit HostileVisitor(Options options = {})
      : server_(Server::listen({"ws", "127.0.0.1", 0}, options, Pages::in(site_.folder()).value())
                    .value()) {}

  std::uint16_t port() const { return server_->address().port; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port()); }
  std::string origin() const { return "http://" + host(); }
  std::string pass() const {
    const std::string cookie = server_->entry().cookie();
    return cookie.substr(0, cookie.find(';'));
  }

  /// All that the server says to a request, up to the end of the connection.
  std::string asked(const std::string& request) const {
    RawVisitor visitor(port());
    EXPECT_TRUE(visitor.send(request));
    return visitor.read_to_end();
  }
  std::string get(const std::string& path) const {
    return asked("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n");
  }
  std::string post_token(const std::string& from, const std::string& token) const {
    return asked("POST /token HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + from +
                 "\r\nAuthorization: Bearer " + token + "\r\nContent-Length: 0\r\n\r\n");
  }

  /// A page that got in, and the node's end of its connection.
  std::pair<std::unique_ptr<RawVisitor>, std::unique_ptr<ride::Connection>> page() {
    auto visitor = std::make_unique<RawVisitor>(port());
    EXPECT_TRUE(visitor->send(upgrade(host(), origin(), pass())));
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(server_->handle(), 0, {.read = true});
    while (poller->wait(base::Duration::max()).empty()) {
    }
    auto connection = server_->accept();
    EXPECT_NE(connection, nullptr);
    std::string head;
    while (!head.ends_with("\r\n\r\n")) head += next_byte(*visitor);
    EXPECT_THAT(head, StartsWith("HTTP/1.1 101"));
    return {std::move(visitor), std::move(connection)};
  }

  static char next_byte(RawVisitor& visitor) {
    std::byte byte{};
    std::size_t size = 0;
    visitor.socket().wait_and_receive(std::span(&byte, 1), size, kPatience);
    return static_cast<char>(byte);
  }

  /// What comes to the node, until the connection ends.
  static std::size_t bytes_at(ride::Connection& connection) {
    std::vector<std::byte> room(1 << 16);
    std::size_t all = 0;
    std::size_t size = 0;
    while (connection.wait_and_receive(room, size, kPatience) == ride::Progress::kDone) all += size;
    return all;
  }

  Site site_;
  std::unique_ptr<Server> server_;
};

TEST_F(HostileVisitor, OnlyTheTokenFromItsOwnPageIsExchangedForTheCookie) {
  const std::string token = server_->entry().token();
  EXPECT_THAT(post_token(origin(), token), HasSubstr("set-cookie: " + server_->entry().cookie()));
  for (const auto& [from, given] :
       {std::pair(origin(), std::string(32, '0')), std::pair(origin(), std::string()),
        std::pair(origin(), token.substr(1)), std::pair(std::string("http://evil.example"), token),
        std::pair(std::string("null"), token)}) {
    const std::string answer = post_token(from, given);
    EXPECT_THAT(answer, HasSubstr(" 403 ")) << from << " " << given;
    EXPECT_THAT(answer, Not(HasSubstr("cookie")));
  }
}

TEST_F(HostileVisitor, NoSocketWithoutTheCookieTheOriginAndTheHost) {
  const std::string wrong = pass().substr(0, pass().size() - 1) + "x";
  for (const std::string& request :
       {upgrade(host(), origin(), ""), upgrade(host(), origin(), wrong),
        upgrade(host(), origin(), "armature-1=" + server_->entry().token()),
        upgrade(host(), "http://evil.example", pass()), upgrade(host(), "", pass()),
        upgrade("evil.example:" + std::to_string(port()), "http://evil.example", pass()),
        upgrade("evil.example", origin(), pass())}) {
    EXPECT_THAT(asked(request), HasSubstr(" 403 ")) << request;
  }
  EXPECT_EQ(server_->accept(), nullptr);
  EXPECT_NE(page().second, nullptr);
}

TEST_F(HostileVisitor, AnotherHostGetsNoFile) {
  EXPECT_THAT(get("/"), EndsWith("<p>first</p>"));
  EXPECT_THAT(asked("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), HasSubstr(" 403 "));
  EXPECT_THAT(asked("GET / HTTP/1.0\r\n\r\n"), HasSubstr(" 403 "));
}

TEST_F(HostileVisitor, NoPathLeadsOutOfTheFolder) {
  for (const char* path :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt",
        "/more/%2e%2e/%2e%2e/secret.txt", "/more/..%5c..%5csecret.txt", "/%2e%2e%2fsecret.txt",
        "/link.txt", "//secret.txt", "/.hidden.html", "/%2ehidden.html", "/robot.key",
        "/index.html%00.png", "/%252e%252e/secret.txt", "/etc/passwd",
        "/../../../../../../etc/passwd"}) {
    const std::string answer = get(path);
    EXPECT_THAT(answer, Not(HasSubstr("HTTP/1.1 200"))) << path;
    EXPECT_THAT(answer, Not(HasSubstr("secret\r"))) << path;
  }
}

TEST_F(HostileVisitor, EveryAnswerSaysWhatPagesMayUse) {
  for (const std::string& answer : {get("/"), get("/nothing"), post_token(origin(), "wrong")}) {
    EXPECT_THAT(answer,
                HasSubstr("content-security-policy: default-src 'self'; connect-src 'self'"));
    EXPECT_THAT(answer, HasSubstr("x-content-type-options: nosniff"));
    EXPECT_THAT(answer, HasSubstr("cross-origin-resource-policy: same-origin"));
  }
}

TEST_F(HostileVisitor, ATextFrameEndsTheConnection) {
  const auto [visitor, connection] = page();
  visitor->send(frame(kText, "RIDE"));
  EXPECT_EQ(bytes_at(*connection), 0u);
  EXPECT_THAT(visitor->read_to_end(), HasSubstr("frames are binary"));
}

TEST_F(HostileVisitor, AFrameOf16MBEndsTheConnectionBeforeItIsThere) {
  const auto [visitor, connection] = page();
  visitor->send(frame(kBinary, std::string(1000, 'x'), 16U << 20));
  EXPECT_EQ(bytes_at(*connection), 0u);
  EXPECT_THAT(visitor->read_to_end(), HasSubstr("a frame is too large"));
}

TEST_F(HostileVisitor, AFrameOf64KiBArrivesAndALargerOneDoesNot) {
  const auto [visitor, connection] = page();
  const std::string most(64 * 1024, 'x');
  visitor->send(frame(kBinary, most));
  visitor->send(frame(kBinary, most + "x"));
  EXPECT_EQ(bytes_at(*connection), most.size());
}

TEST_F(HostileVisitor, PingsAreNoBytesOfTheNode) {
  const auto [visitor, connection] = page();
  for (int i = 0; i < 1000; ++i) visitor->send(frame(kPing, "?"));
  visitor->send(frame(kBinary, "1"));
  visitor->send(frame(kText, "end"));
  EXPECT_EQ(bytes_at(*connection), 1u);
}

TEST_F(HostileVisitor, WhoSendsMoreThanTheNodeTakesHasToWait) {
  const auto [visitor, connection] = page();
  const std::string piece = frame(kBinary, std::string(60 * 1024, 'x'));
  std::size_t sent = 0;
  // Until nothing more goes into the kernel's buffers on the way: nobody else keeps anything.
  while (visitor->socket().wait_until_writable(500ms) == StreamStatus::kDone) {
    std::size_t now = 0;
    const auto bytes = std::as_bytes(std::span(piece));
    if (visitor->socket().send(bytes.subspan(sent % piece.size()), now) != StreamStatus::kDone)
      break;
    sent += now;
    ASSERT_LT(sent, 64u << 20);
  }
  EXPECT_GT(sent, piece.size());
}

TEST_F(HostileVisitor, WhatTheNodeSentBeforeItLeftArrivesAndThenTheEnd) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{100'000}}) {
    auto [visitor, connection] = page();
    const std::vector<std::byte> bytes(size, std::byte{'y'});
    std::span<const std::byte> left = bytes;
    while (!left.empty()) {
      std::size_t sent = 0;
      ASSERT_EQ(connection->send(left, sent), ride::Progress::kDone);
      left = left.subspan(sent);
    }
    connection.reset();
    const std::string all = visitor->read_to_end();
    EXPECT_TRUE(visitor->ended());
    EXPECT_THAT(all, HasSubstr("the application has left"));
    EXPECT_GE(std::ranges::count(all, 'y'), static_cast<std::ptrdiff_t>(size));
  }
}

class FewPlaces : public HostileVisitor {
 protected:
  FewPlaces() : HostileVisitor({.connections = 4}) {}
};

TEST_F(FewPlaces, WhoComesWhenAllPlacesAreTakenIsSentAwayAndTheOthersAreServed) {
  const auto [visitor, connection] = page();
  std::vector<std::unique_ptr<RawVisitor>> silent;
  for (int i = 0; i < 3; ++i) silent.push_back(std::make_unique<RawVisitor>(port()));
  RawVisitor late(port());
  EXPECT_EQ(late.read_to_end(), "");
  EXPECT_TRUE(late.ended());
  visitor->send(frame(kBinary, "still here"));
  visitor->send(frame(kText, "end"));
  EXPECT_EQ(bytes_at(*connection), 10u);
}

TEST_F(FewPlaces, AHalfOpenConnectionGivesItsPlaceBack) {
  std::vector<std::unique_ptr<RawVisitor>> silent;
  for (int i = 0; i < 4; ++i) silent.push_back(std::make_unique<RawVisitor>(port()));
  silent[0]->send("GET / HTTP/1.1\r\nHost: ");
  for (const auto& each : silent) {
    each->read_to_end();
    EXPECT_TRUE(each->ended());
  }
  EXPECT_THAT(get("/"), EndsWith("<p>first</p>"));
}

class ShortPatience : public HostileVisitor {
 protected:
  ShortPatience() : HostileVisitor({.time_to_take = 1s}) {}
};

TEST_F(ShortPatience, AReaderThatStopsReadingIsDisconnected) {
  const auto [visitor, connection] = page();
  const std::vector<std::byte> piece(1 << 16);
  std::size_t all = 0;
  ride::Progress progress = ride::Progress::kDone;
  auto poller = std::move(platform::Poller::make()).value();
  poller->add(connection->handle(), 0, {.write = true});
  while (progress != ride::Progress::kGone) {
    std::size_t sent = 0;
    progress = connection->send(piece, sent);
    if (progress == ride::Progress::kDone) all += sent;
    if (progress == ride::Progress::kWantWrite) poller->wait(kPatience);
    ASSERT_LT(all, 64u << 20);
  }
  EXPECT_GT(all, 0u);
}

TEST_F(ShortPatience, AReaderThatHasNothingToReadStays) {
  const auto [visitor, connection] = page();
  std::array<std::byte, 8> room{};
  std::size_t size = 0;
  EXPECT_EQ(connection->wait_and_receive(room, size, 3s), ride::Progress::kWantRead);
  visitor->send(frame(kBinary, "1"));
  EXPECT_EQ(connection->wait_and_receive(room, size, kPatience), ride::Progress::kDone);
}

}  // namespace
}  // namespace armature::websocket::internal
