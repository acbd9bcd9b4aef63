// SPDX-License-Identifier: Apache-2.0
#include "armature/websocket/transport.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"
#include "armature/testing/transport_conformance.hpp"
#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"

namespace armature::ride {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using websocket::internal::Pages;
using websocket::internal::Server;
using websocket::internal::Site;
using websocket::internal::TestPage;

/// What a browser adds to the transport: the other end.
class WithBrowser final : public Transport {
 public:
  std::string scheme() const override { return "ws"; }
  bool safe(const Address&) const override { return true; }
  base::Result<std::unique_ptr<Listener>> listen(const Address& address) override {
    auto server = Server::listen(address, {}, Pages::in(site_.folder()).value());
    if (!server) return base::Error{server.error()};
    const std::string cookie = server.value()->entry().cookie();
    pass_ = cookie.substr(0, cookie.find(';'));
    return std::unique_ptr<Listener>(std::move(server).value());
  }
  base::Result<std::unique_ptr<Connection>> connect(const Address& address) override {
    auto socket = platform::StreamSocket::connect_tcp(address.host, address.port);
    if (!socket) return base::Error{socket.error()};
    const std::string host = address.host + ":" + std::to_string(address.port);
    return std::unique_ptr<Connection>(
        std::make_unique<TestPage>(std::move(socket).value(), host, pass_));
  }

 private:
  Site site_;
  std::string pass_;
};

INSTANTIATE_TEST_SUITE_P(Websocket, TransportConformance,
                         testing::Values(TransportCase{
                             "websocket", [] { return std::make_unique<WithBrowser>(); },
                             [] {
                               return Address{"ws", "127.0.0.1", 0};
                             }}),
                         [](const auto& which) { return which.param.name; });

class WebTransport : public ::testing::Test {
 protected:
  WebTransport() : transport_(websocket::make_transport({.pages = site_.folder()}, diagnostics_)) {}

  Site site_;
  base::Diagnostics diagnostics_;
  std::shared_ptr<websocket::Transport> transport_;
};

TEST_F(WebTransport, IsSafeOnLoopbackOnlyAndListensNowhereElse) {
  EXPECT_EQ(transport_->scheme(), "ws");
  EXPECT_TRUE(transport_->safe({"ws", "127.0.0.1", 1}));
  EXPECT_TRUE(transport_->safe({"ws", "::1", 1}));
  EXPECT_FALSE(transport_->safe({"ws", "0.0.0.0", 1}));
  const auto refused = transport_->listen({"ws", "0.0.0.0", 0});
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), HasSubstr("listen at 127.0.0.1 or ::1, or at wss://"));
}

/// The address of a page when one starts that keeps what lets in at `path`.
std::string page_of_a_start(const std::string& pages, const std::string& path) {
  base::Diagnostics diagnostics;
  const auto transport = websocket::make_transport({.pages = pages, .secrets = path}, diagnostics);
  const auto listener = transport->listen({"ws", "127.0.0.1", 0});
  EXPECT_TRUE(listener);
  const std::string page = transport->pages().front();
  return page.substr(page.find('#'));
}

TEST_F(WebTransport, KeepsItsTokenForTheNextStartIfItHasAFileForIt) {
  const std::string path = site_.folder() + "_entry";
  const std::string first = page_of_a_start(site_.folder(), path);
  EXPECT_EQ(page_of_a_start(site_.folder(), path), first);
  EXPECT_NE(page_of_a_start(site_.folder(), ""), first);
  for (const std::string& damaged : {std::string("x"), std::string(66, '\n'),
                                     std::string(32, 'a') + "\n" + std::string(32, 'a') + "\n"}) {
    ASSERT_TRUE(platform::write_file(path, damaged));
    const std::string anew = page_of_a_start(site_.folder(), path);
    EXPECT_EQ(anew.size(), first.size()) << damaged;
    EXPECT_EQ(anew.find(std::string(32, 'a')), std::string::npos);
    EXPECT_EQ(page_of_a_start(site_.folder(), path), anew);
  }
  std::filesystem::remove(path);
}

TEST_F(WebTransport, TellsAnAddressWithATokenOfItsOwn) {
  const auto first = transport_->listen({"ws", "127.0.0.1", 0});
  const auto second = transport_->listen({"ws", "::1", 0});
  ASSERT_TRUE(first.ok() && second.ok());
  const auto urls = transport_->pages();
  ASSERT_EQ(urls.size(), 2u);
  EXPECT_THAT(urls[0], MatchesRegex("http://127.0.0.1:[0-9]+/#[0-9a-f]{32}"));
  EXPECT_THAT(urls[1], MatchesRegex("http://\\[::1\\]:[0-9]+/#[0-9a-f]{32}"));
  EXPECT_NE(urls[0].substr(urls[0].size() - 32), urls[1].substr(urls[1].size() - 32));
}

TEST(WebTransportOptions, AFolderWithoutPagesIsRefused) {
  for (const auto& [folder, text] :
       {std::pair("/nowhere", "cannot be read"), std::pair("/", "has no index.html")}) {
    base::Diagnostics diagnostics;
    EXPECT_EQ(websocket::make_transport({.pages = folder}, diagnostics), nullptr);
    ASSERT_EQ(diagnostics.error_count(), 1u);
    EXPECT_THAT(diagnostics.all()[0].message, HasSubstr(text));
  }
}

}  // namespace
}  // namespace armature::ride
