// SPDX-License-Identifier: Apache-2.0
// Programs that connect over TLS: who lets in whom.
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/ride/node.hpp"
#include "armature/websocket/internal/test_authority.hpp"
#include "armature/websocket/internal/test_client.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket {
namespace {

using internal::kPatience;
using internal::problem_at;
using internal::problem_of;
using internal::TestAuthorities;
using internal::transport_with;
using ::testing::HasSubstr;

/// A node that serves pages over TLS, and knows programs by its authority.
class EncryptedNode : public ::testing::Test {
 protected:
  EncryptedNode() {
    const Options options = serving("robot");
    ride::NodeOptions node;
    node.transports.push_back(transport_with(options));
    node.allows = [](const ride::AccessQuestion&) { return true; };
    node_ = std::make_unique<ride::Node>(std::move(node));
    const auto listening = node_->listen("wss://127.0.0.1:0");
    EXPECT_TRUE(listening.ok()) << listening.error();
    port_ = listening.value().port;
  }

  Options serving(const std::string& name) const {
    Options options = files_.issue(name);
    options.pages = site_.folder();
    return options;
  }
  /// Who only trusts.
  std::shared_ptr<Transport> anonymous(const std::string& authority = "authority") const {
    Options options;
    options.authority = files_.path(authority + ".pem");
    return transport_with(options);
  }

  internal::Site site_;
  const TestAuthorities files_;
  std::unique_ptr<ride::Node> node_;
  std::uint16_t port_ = 0;
};

TEST_F(EncryptedNode, AProgramThatHasACertificateConnectsWithoutAToken) {
  ride::NodeOptions options;
  options.transports.push_back(transport_with(files_.issue("anna")));
  ride::Node program(options);
  ride::Peer& peer = program.connect("wss://localhost:" + std::to_string(port_));
  ASSERT_TRUE(peer.wait_until_connected(kPatience).ok());
  EXPECT_TRUE(peer.components(kPatience).ok());
}

TEST_F(EncryptedNode, BothSidesAreKnownByTheirCertificatesAsOverTls) {
  node_.reset();  // libwebsockets leaks where two servers that know an authority are there at once
  const auto listening = transport_with(serving("other"))->listen({"wss", "127.0.0.1", 0});
  ASSERT_TRUE(listening.ok()) << listening.error();
  const auto near = transport_with(files_.issue("anna"))->connect(listening.value()->address());
  ASSERT_TRUE(near.ok()) << near.error();
  ASSERT_EQ(problem_of(*near.value()), "");
  std::unique_ptr<ride::Connection> far;
  auto poller = std::move(platform::Poller::make()).value();
  poller->add(listening.value()->handle(), 0, {true, false});
  while ((far = listening.value()->accept()) == nullptr) poller->wait(base::Duration::max());
  EXPECT_EQ(near.value()->identity(), "other");
  EXPECT_EQ(far->identity(), "anna@tls");
}

TEST_F(EncryptedNode, AProgramWithoutACertificateAndWithoutTheTokenIsSentAway) {
  EXPECT_THAT(problem_at(*anonymous(), {"wss", "127.0.0.1", port_}),
              HasSubstr("lets this side not in (403)"));
}

TEST_F(EncryptedNode, ACertificateOfAnotherAuthorityLetsNobodyIn) {
  files_.make("elsewhere");
  const auto eve = transport_with(files_.issue("eve", "elsewhere"));
  // It says so, or resets the connection before that is read.
  EXPECT_NE(problem_at(*eve, {"wss", "127.0.0.1", port_}), "");
  EXPECT_EQ(node_->statistics().connections, 0u);
}

TEST_F(EncryptedNode, WhomTheSystemTrustsForTheWebIsNobodyHere) {
  node_.reset();
  files_.make("elsewhere");
  ::setenv("SSL_CERT_FILE", files_.path("elsewhere.pem").c_str(), 1);  // where OpenSSL looks
  const auto listening = transport_with(serving("other"))->listen({"wss", "127.0.0.1", 0});
  const auto eve = transport_with(files_.issue("eve", "elsewhere"));
  EXPECT_NE(problem_at(*eve, listening.value()->address()), "");
  ::unsetenv("SSL_CERT_FILE");
  EXPECT_EQ(listening.value()->accept(), nullptr);
}

TEST_F(EncryptedNode, TheCertificateThereHasToBeForTheNameThatIsDialledAndOfTheAuthority) {
  const ride::Address wrong{"wss", "127.0.0.1", port_, "robot.lab"};
  auto connection = anonymous()->connect(wrong);
  ASSERT_TRUE(connection.ok());
  EXPECT_THAT(problem_of(*connection.value()), HasSubstr("is not for 'robot.lab', but for"));
  files_.make("elsewhere");
  EXPECT_THAT(problem_at(*anonymous("elsewhere"), {"wss", "127.0.0.1", port_}),
              HasSubstr("its authority 'authority' is not the one of this side"));
}

TEST_F(EncryptedNode, WhoDoesNotEncryptFindsNoWebSocket) {
  EXPECT_THAT(problem_at(*transport_with({}), {"ws", "127.0.0.1", port_}),
              HasSubstr("it answered nothing"));
}

TEST_F(EncryptedNode, WithoutAnAuthorityNobodyIsConnectedTo) {
  Options options = serving("alone");
  options.authority.clear();
  EXPECT_THAT(problem_at(*transport_with(options), {"wss", "127.0.0.1", port_}),
              HasSubstr("no authority is given"));
}

}  // namespace
}  // namespace armature::websocket
