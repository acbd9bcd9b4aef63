// SPDX-License-Identifier: Apache-2.0
// A node that serves pages, beside peers over TCP.
#include "armature/ride/node.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket {
namespace {

using internal::frame;
using internal::RawVisitor;
using internal::upgrade;
using ::testing::HasSubstr;

constexpr std::uint8_t kBinary = 2;

class NodeWithPages : public ::testing::Test {
 protected:
  NodeWithPages() {
    const auto served = node_->listen("ws://127.0.0.1:0");
    const auto reached = node_->listen("tcp://127.0.0.1:0");
    EXPECT_TRUE(served.ok() && reached.ok());
    port_ = served.value().port;
    tcp_ = reached.value().text();
  }

  static std::shared_ptr<Transport> transport_of(const std::string& folder) {
    base::Diagnostics diagnostics;
    auto made = make_transport({.pages = folder}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.to_text();
    return made;
  }
  std::unique_ptr<ride::Node> make_node() {
    ride::NodeOptions options;
    options.transports.push_back(transport_);
    return std::make_unique<ride::Node>(options);
  }

  /// A page as a browser opens it: the token for the cookie, then the socket.
  std::unique_ptr<RawVisitor> page() {
    const std::string host = "127.0.0.1:" + std::to_string(port_);
    const std::string url = transport_->pages().front();
    RawVisitor visitor(port_);
    visitor.send("POST /token HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                 "\r\nAuthorization: Bearer " + url.substr(url.find('#') + 1) +
                 "\r\nContent-Length: 0\r\n\r\n");
    const std::string answer = visitor.read_to_end();
    const std::size_t cookie = answer.find("armature-");
    EXPECT_NE(cookie, std::string::npos) << answer;
    auto opened = std::make_unique<RawVisitor>(port_);
    opened->send(
        upgrade(host, "http://" + host, answer.substr(cookie, answer.find(';', cookie) - cookie)));
    return opened;
  }

  /// A CONTROL message, as docs/ride.md has it.
  static std::string control(unsigned char code) {
    std::string message("RIDE\0\0\0\0\5\0\x24\0\0\0\0\0", 16);
    message += static_cast<char>(code);
    return message + std::string(19, '\0');
  }

  internal::Site site_;
  const std::shared_ptr<Transport> transport_ = transport_of(site_.folder());
  std::unique_ptr<ride::Node> node_ = make_node();
  std::uint16_t port_ = 0;
  std::string tcp_;
};

TEST_F(NodeWithPages, AnswersAPageHoweverItsMessagesAreDividedIntoFrames) {
  const auto visitor = page();
  const std::string ping = control(17);
  visitor->send(frame(kBinary, ping + ping.substr(0, 5)) + frame(kBinary, "") +
                frame(kBinary, ping.substr(5)));
  std::string all;
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = all.find(what, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  while (count("RIDE") < 2) {
    const std::string more = visitor->read_to_end(std::chrono::milliseconds(100));
    all += more;
    ASSERT_FALSE(visitor->ended()) << all;
  }
  EXPECT_EQ(count(control(18)), 2u);
}

TEST_F(NodeWithPages, NoiseOfAPageIsAnsweredOnceAndDisconnected) {
  const auto visitor = page();
  visitor->send(frame(kBinary, std::string(1000, 'x')));
  const std::string all = visitor->read_to_end();
  EXPECT_TRUE(visitor->ended());
  EXPECT_THAT(all, HasSubstr("RIDE"));
}

TEST_F(NodeWithPages, AFloodOfPagesThatReadNothingFailsNoRequestOfOthers) {
  std::string flood;
  while (flood.size() < 50'000) flood += control(17);
  flood = frame(kBinary, flood);
  std::atomic<bool> enough{false};
  std::atomic<std::size_t> sent{0};
  std::vector<std::thread> pages;
  for (int i = 0; i < 4; ++i) {
    pages.emplace_back([&, visitor = std::shared_ptr<RawVisitor>(page())] {
      std::size_t at = 0;  // never in the middle of a frame, whatever the kernel takes
      while (!enough) {
        std::size_t now = 0;
        const auto bytes = std::as_bytes(std::span(flood)).subspan(at);
        const auto status = visitor->socket().send(bytes, now);
        if (status == platform::StreamStatus::kGone) return;
        if (status == platform::StreamStatus::kLater) {
          visitor->socket().wait_until_writable(std::chrono::milliseconds(10));
          continue;
        }
        at = (at + now) % flood.size();
        sent += now;
      }
    });
  }
  ride::Node other;
  ride::Peer& peer = other.connect(tcp_);
  EXPECT_TRUE(peer.wait_until_connected(internal::kPatience).ok());
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(peer.components(internal::kPatience).ok()) << i;
  enough = true;
  for (std::thread& each : pages) each.join();
  EXPECT_GT(sent.load(), flood.size());
  EXPECT_LT(node_->statistics().memory_bytes, ride::Limits{}.memory_bytes);
}

TEST_F(NodeWithPages, EndsWithItsPages) {
  const auto visitor = page();
  visitor->send(frame(kBinary, control(17)));
  std::string all;
  while (all.find("RIDE") == std::string::npos) {
    all += visitor->read_to_end(std::chrono::milliseconds(100));
    ASSERT_FALSE(visitor->ended()) << all;
  }
  node_.reset();
  visitor->read_to_end();
  EXPECT_TRUE(visitor->ended());
}

}  // namespace
}  // namespace armature::websocket
