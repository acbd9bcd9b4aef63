// SPDX-License-Identifier: Apache-2.0
// A program that connects to a WebSocket: to those of nodes, and to what is none.
#include "armature/websocket/internal/client.hpp"

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/node.hpp"
#include "armature/testing/transport_conformance.hpp"
#include "armature/websocket/internal/handshake.hpp"
#include "armature/websocket/internal/test_authority.hpp"
#include "armature/websocket/internal/test_client.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"
#include "armature/websocket/internal/tokens.hpp"
#include "armature/websocket/internal/unframer.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::ride {
namespace {

using websocket::internal::Site;
using websocket::internal::TestAuthorities;

std::shared_ptr<websocket::Transport> made(const websocket::Options& options) {
  base::Diagnostics diagnostics;
  auto transport = websocket::make_transport(options, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  return transport;
}

/// Both ends: one listens, and the other is told its token.
class BothEnds final : public Transport {
 public:
  explicit BothEnds(websocket::Options options,
                    std::shared_ptr<const TestAuthorities> files = nullptr)
      : files_(std::move(files)), options_(std::move(options)) {
    options_.pages = site_.folder();
    listening_ = made(options_);
  }
  std::string scheme() const override { return listening_->scheme(); }
  bool safe(const Address&) const override { return true; }
  base::Result<std::unique_ptr<Listener>> listen(const Address& address) override {
    auto listener = listening_->listen(address);
    if (!listener) return listener;
    websocket::Options options = options_;
    options.pages.clear();
    options.tokens = site_.folder() + "_tokens";
    std::ofstream(options.tokens) << listening_->pages().back() << "\n";
    std::filesystem::permissions(
        options.tokens, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    connecting_ = made(options);
    std::filesystem::remove(options.tokens);
    return listener;
  }
  base::Result<std::unique_ptr<Connection>> connect(const Address& address) override {
    return connecting_->connect(address);
  }

 private:
  Site site_;
  const std::shared_ptr<const TestAuthorities> files_;
  websocket::Options options_;
  std::shared_ptr<websocket::Transport> listening_;
  std::shared_ptr<websocket::Transport> connecting_;
};

std::unique_ptr<Transport> make_ws() { return std::make_unique<BothEnds>(websocket::Options{}); }

/// Both ends have one certificate.
std::unique_ptr<Transport> make_wss() {
  const auto files = std::make_shared<const TestAuthorities>();
  return std::make_unique<BothEnds>(files->issue("robot"), files);
}

INSTANTIATE_TEST_SUITE_P(WebsocketClient, TransportConformance,
                         testing::Values(TransportCase{"ws", make_ws,
                                                       [] {
                                                         return Address{"ws", "127.0.0.1", 0};
                                                       }},
                                         TransportCase{"wss", make_wss,
                                                       [] {
                                                         return Address{"wss", "127.0.0.1", 0};
                                                       }}),
                         [](const auto& which) { return which.param.name; });

}  // namespace
}  // namespace armature::ride

namespace armature::websocket {
namespace {

using internal::kPatience;
using internal::problem_at;
using internal::problem_of;
using internal::transport_with;
using ::testing::HasSubstr;
using ::testing::Not;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// A server of a test: answers one visitor, by what it has asked.
class Server {
 public:
  explicit Server(std::function<std::string(const std::string& request)> answer)
      : listener_(std::move(platform::StreamListener::listen_tcp("127.0.0.1", 0)).value()),
        thread_([this, answer = std::move(answer)] { serve(answer); }) {}
  ~Server() { thread_.join(); }
  ride::Address address() const { return {"ws", "127.0.0.1", listener_->port()}; }
  /// What came behind the request, to its end.
  const std::string& received() {
    thread_.join();
    thread_ = std::thread([] {});
    return received_;
  }

 private:
  void serve(const std::function<std::string(const std::string&)>& answer) {
    std::unique_ptr<platform::StreamSocket> socket;
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(listener_->handle(), 0, {true, false});
    while (socket == nullptr) {
      poller->wait(base::Duration::max());
      socket = listener_->accept();
    }
    std::string request;
    std::vector<std::byte> room(1 << 16);
    const auto read = [&] {
      std::size_t size = 0;
      const auto status = socket->wait_and_receive(room, size, kPatience);
      if (status != platform::StreamStatus::kDone) return false;
      request.append(reinterpret_cast<const char*>(room.data()), size);
      return true;
    };
    while (request.find("\r\n\r\n") == std::string::npos && read()) {
    }
    const std::string text = answer(request);
    request.erase(0, request.find("\r\n\r\n") + 4);
    std::size_t sent = 0;
    if (!text.empty()) socket->send(std::as_bytes(std::span(text)), sent);
    if (text.find("101") == std::string::npos) return;
    while (read()) {
    }
    received_ = request;
  }

  const std::unique_ptr<platform::StreamListener> listener_;
  std::string received_;
  std::thread thread_;
};

/// As a node answers.
std::string good_answer(const std::string& request) {
  const std::string name = "Sec-WebSocket-Key: ";
  const std::size_t at = request.find(name) + name.size();
  const std::string key = request.substr(at, request.find("\r\n", at) - at);
  const std::string text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  unsigned char digest[20];
  EVP_Digest(text.data(), text.size(), digest, nullptr, EVP_sha1(), nullptr);
  return "HTTP/1.1 101 Switching Protocols\r\nUpgrade: WebSocket\r\nConnection: Upgrade\r\n"
         "sec-websocket-accept: " +
         internal::base64({reinterpret_cast<const char*>(digest), 20}) +
         "\r\nSec-WebSocket-Protocol: ride\r\n\r\n";
}

TEST(WebSocketHandshake, HasTheKeyAndTheAnswerOfTheStandard) {
  const std::string head =
      "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\nSec-WebSocket-Protocol: ride\r\n\r\n";
  EXPECT_EQ(internal::problem_of(head, "dGhlIHNhbXBsZSBub25jZQ=="), "");
  EXPECT_THAT(internal::problem_of(head, "AAAAIHNhbXBsZSBub25jZQ=="), HasSubstr("another request"));
}

TEST(WebSocketHandshake, NamesTheHostAsTheOtherSideKnowsItself) {
  EXPECT_EQ(internal::door_of("Robot.lab", 8443, true).host, "robot.lab:8443");
  EXPECT_EQ(internal::door_of("::1", 8080, false).origin, "http://[::1]:8080");
  EXPECT_EQ(internal::door_of("robot.lab", 443, true).origin, "https://robot.lab");
}

TEST(WebSocketClient, AnUnknownHostIsTold) {
  const auto client = transport_with({});
  EXPECT_THAT(problem_at(*client, {"ws", "no.such.host.invalid", 8080}),
              HasSubstr("no.such.host.invalid"));
}

TEST(WebSocketClient, WhereThereIsNoWebSocketItSaysWhatIsThere) {
  const std::pair<const char*, const char*> kCases[] = {
      {"HTTP/1.1 404 Not Found\r\n\r\n", "no WebSocket is there: it answered '404 Not Found'"},
      {"HTTP/1.1 200 O\x1bK\r\n\r\n", "no WebSocket is there: it answered '200 O?K'"},
      {"HTTP/1.1 403 Forbidden\r\n\r\n", "it expects its token, or a certificate"},
      {"RIDE\x01", "what it sent is no answer of HTTP"},
      {"", "it answered nothing: "},
  };
  for (const auto& [text, expected] : kCases) {
    const Server server([text = std::string(text)](const std::string&) { return text; });
    const auto client = transport_with({});
    EXPECT_THAT(problem_at(*client, server.address()), HasSubstr(expected));
  }
}

TEST(WebSocketClient, AnAnswerThatHasNoEndIsRefused) {
  const Server server([](const std::string&) { return "HTTP/1.1 200 " + std::string(9000, 'x'); });
  const auto client = transport_with({});
  EXPECT_EQ(problem_at(*client, server.address()), "its answer has no end");
}

TEST(WebSocketClient, AnotherSubprotocolIsRefusedAndSoIsNone) {
  for (const auto& [by, expected] :
       {std::pair("Sec-WebSocket-Protocol: chat", "has the subprotocol 'chat', expected 'ride'"),
        std::pair("X: y", "has the subprotocol '', expected 'ride'"),
        std::pair("Sec-WebSocket-Protocol: ride\r\nSec-WebSocket-Extensions: permessage-deflate",
                  "an extension that this side has not offered")}) {
    const Server server([by = std::string(by)](const std::string& request) {
      return replaced(good_answer(request), "Sec-WebSocket-Protocol: ride", by);
    });
    const auto client = transport_with({});
    EXPECT_THAT(problem_at(*client, server.address()), HasSubstr(expected));
  }
}

/// What a client says of frames that come behind the handshake, and what it answers to them.
struct Heard {
  std::string bytes;
  std::string problem;
  std::string answered;
};

Heard hear(const std::string& frames) {
  Server server([&](const std::string& request) { return good_answer(request) + frames; });
  const auto client = transport_with({});
  auto connection = std::move(client->connect(server.address())).value();
  EXPECT_EQ(problem_of(*connection), "");
  Heard heard;
  std::vector<std::byte> room(1 << 14);
  std::size_t size = 0;
  ride::Progress progress = ride::Progress::kDone;
  while ((progress = connection->wait_and_receive(room, size, std::chrono::milliseconds(200))) ==
         ride::Progress::kDone) {
    heard.bytes.append(reinterpret_cast<const char*>(room.data()), size);
  }
  if (progress == ride::Progress::kGone) heard.problem = connection->problem();
  connection.reset();
  heard.answered = server.received();
  return heard;
}

std::string unmasked(const std::string& frame) {
  std::string text;
  for (std::size_t i = 6; i < frame.size(); ++i) {
    text += static_cast<char>(frame[i] ^ frame[2 + (i - 6) % 4]);
  }
  return text;
}

TEST(WebSocketClient, TakesFramesHoweverTheyAreDivided) {
  EXPECT_EQ(hear(std::string("\x02\x02"
                             "ab"
                             "\x80\x01"
                             "c"
                             "\x82\x00"
                             "\x82\x7e\x00\x02"
                             "de",
                             16))
                .bytes,
            "abcde");
}

TEST(WebSocketClient, WhatIsNoFrameOfANodeEndsTheConnection) {
  EXPECT_THAT(hear("\x81\x01x").problem, HasSubstr("a frame of text"));
  EXPECT_THAT(hear("\xc2\x01x").problem, HasSubstr("an extension"));
  EXPECT_THAT(hear("\x82\x81mmmmx").problem, HasSubstr("masks its frames"));
  EXPECT_THAT(hear("\x83\x01x").problem, HasSubstr("unknown kind"));
  EXPECT_THAT(hear(std::string("\x89\x7e\x00\x80", 4)).problem, HasSubstr("too large"));
}

TEST(WebSocketClient, APingIsAnsweredWithItsPayload) {
  const Heard heard = hear("\x89\x02hi");
  ASSERT_GE(heard.answered.size(), 8u);
  EXPECT_EQ(heard.answered.substr(0, 2), "\x8a\x82");
  EXPECT_EQ(unmasked(heard.answered.substr(0, 8)), "hi");
}

TEST(WebSocketClient, TheEndIsSaidAndHeardWithItsReason) {
  EXPECT_EQ(hear("\x88\x05\x03\xe9"
                 "bye")
                .problem,
            "the other side has ended it: bye");
  const std::string last = hear("\x82\x01x").answered;
  ASSERT_EQ(last.size(), 8u);
  EXPECT_EQ(last.substr(0, 2), "\x88\x82");
  EXPECT_EQ(unmasked(last), "\x03\xe8");
}

TEST(WebSocketTokens, EachGoesToItsOwnAddress) {
  base::Diagnostics diagnostics;
  const auto tokens = internal::Tokens::parse(
      "http://127.0.0.1:8080/#4a33af8cfbb791ad7c8467a08ce2b687\n\n"
      "  https://robot.lab/#0033af8cfbb791ad7c8467a08ce2b687 \n",
      "t", diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
  EXPECT_EQ(tokens.of("http://127.0.0.1:8080"), "4a33af8cfbb791ad7c8467a08ce2b687");
  EXPECT_EQ(tokens.of("https://robot.lab"), "0033af8cfbb791ad7c8467a08ce2b687");
  EXPECT_EQ(tokens.of("http://127.0.0.1:8081"), "");
}

TEST(WebSocketTokens, ALineThatIsNoneIsToldByItsPlaceAndNotRepeated) {
  base::Diagnostics diagnostics;
  internal::Tokens::parse("http://127.0.0.1:8080/#zz\nws://a:1/#4a33af8cfbb791ad7c8467a08ce2b687",
                          "t", diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 2u);
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("t:2:1: error: the line is no address of pages"));
  EXPECT_THAT(diagnostics.to_text(), Not(HasSubstr("4a33af8c")));
}

}  // namespace
}  // namespace armature::websocket
