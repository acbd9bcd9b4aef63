// SPDX-License-Identifier: Apache-2.0
// Who is refused, and what both sides are told.
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/sockets/poller.hpp"
#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/tls/internal/connection.hpp"
#include "armature/tls/internal/credentials.hpp"
#include "armature/tls/internal/test_certificates.hpp"

namespace armature::tls::internal {
namespace {

using platform::StreamListener;
using platform::StreamSocket;
using platform::StreamStatus;
using ride::Address;
using ride::Progress;
using ::testing::HasSubstr;

/// Two ends of a connection; a test says what each of them has.
class Handshake : public testing::Test {
 protected:
  /// What a side has that obeys the rules.
  ContextPointer good(const Wish& wish) const {
    base::Diagnostics diagnostics;
    auto made =
        make_context(folder_.write("good", issue(wish, &authority_), authority_), diagnostics);
    EXPECT_TRUE(made) << diagnostics.to_text();
    return made;
  }

  /// What a side has that does not look at its own certificate, nor has to have one.
  ContextPointer careless(const Issued* own) const {
    ContextPointer made(SSL_CTX_new(TLS_method()));
    X509_STORE_add_cert(SSL_CTX_get_cert_store(made.get()), authority_.certificate.get());
    SSL_CTX_set_num_tickets(made.get(), 0);
    if (own != nullptr) {
      SSL_CTX_use_certificate(made.get(), own->certificate.get());
      SSL_CTX_use_PrivateKey(made.get(), own->key.get());
    }
    return made;
  }

  static void wait_until_readable(int handle) {
    auto poller = std::move(platform::Poller::make()).value();
    poller->add(handle, 0, {.read = true});
    while (poller->wait(base::Duration::max()).empty()) {
    }
  }

  std::unique_ptr<StreamSocket> dial() const {
    return std::move(StreamSocket::connect_tcp("127.0.0.1", listener_->port())).value();
  }

  std::unique_ptr<StreamSocket> accept() {
    wait_until_readable(listener_->handle());
    return listener_->accept();
  }

  void connect(SSL_CTX& server, SSL_CTX& client, const Address& dialled = {"tls", "127.0.0.1", 0}) {
    near_ = TlsConnection::dialled(dial(), client, dialled);
    far_ = TlsConnection::accepted(accept(), server);
  }

  /// Takes both ends as far as they get. Who connects is done before the other side has looked at
  /// its certificate: what that thinks of it comes where the first bytes would.
  void shake_hands() {
    const auto settled = [](Progress p) { return p == Progress::kDone || p == Progress::kGone; };
    Progress near = Progress::kWantWrite;
    Progress far = Progress::kWantRead;
    while (!settled(near) || !settled(far)) {
      near = settled(near) ? near : near_->establish();
      if (near == Progress::kGone) near_->shut_down();
      far = settled(far) ? far : far_->establish();
      if (far == Progress::kGone) far_->shut_down();
    }
    if (far == Progress::kDone || near == Progress::kGone) return;
    std::byte room[1];
    std::size_t size = 0;
    EXPECT_EQ(near_->wait_and_receive(room, size, std::chrono::hours(1)), Progress::kGone);
  }

  /// Bytes of one who speaks no TLS, to whoever listens.
  void answer_with(const std::string& bytes, SSL_CTX& server) {
    const auto stranger = dial();
    far_ = TlsConnection::accepted(accept(), server);
    while (stranger->finish_connect() == StreamStatus::kLater) {
    }
    std::size_t sent = 0;
    ASSERT_EQ(stranger->send(std::as_bytes(std::span(bytes)), sent), StreamStatus::kDone);
    Progress far = far_->establish();
    while (far == Progress::kWantRead) {
      wait_until_readable(far_->handle());
      far = far_->establish();
    }
    EXPECT_EQ(far, Progress::kGone);
  }

  Folder folder_;
  Issued authority_ = make_authority();
  Issued other_authority_ = make_authority("other authority");
  std::unique_ptr<StreamListener> listener_ =
      std::move(StreamListener::listen_tcp("127.0.0.1", 0)).value();
  std::unique_ptr<TlsConnection> near_;
  std::unique_ptr<TlsConnection> far_;
};

TEST_F(Handshake, BothSidesKnowEachOther) {
  connect(*good({}), *good({.common_name = "operator", .names = ""}));
  EXPECT_EQ(far_->identity(), "");
  near_->establish();
  while (far_->establish() != Progress::kDone) near_->establish();
  EXPECT_EQ(near_->establish(), Progress::kDone);
  EXPECT_EQ(far_->identity(), "operator");
  EXPECT_EQ(near_->identity(), "robot");
  EXPECT_THAT(far_->other_end(), HasSubstr("(operator)"));
}

TEST_F(Handshake, WhoHasNoCertificateIsRefused) {
  connect(*good({}), *careless(nullptr));
  shake_hands();
  EXPECT_EQ(far_->problem(), "it has no certificate");
  EXPECT_EQ(near_->problem(), "it refuses peers without a certificate");
}

TEST_F(Handshake, AnExpiredCertificateIsRefused) {
  const Issued old = issue({.common_name = "anna", .from_s = -7200, .until_s = -3600}, &authority_);
  connect(*good({}), *careless(&old));
  shake_hands();
  EXPECT_THAT(far_->problem(), HasSubstr("its certificate 'anna' expired on 20"));
  EXPECT_EQ(near_->problem(), "it refuses the certificate of this side: it has expired");
}

TEST_F(Handshake, ACertificateOfTheFutureIsRefused) {
  const Issued early = issue({.common_name = "anna", .from_s = 3600, .until_s = 7200}, &authority_);
  connect(*good({}), *careless(&early));
  shake_hands();
  EXPECT_THAT(far_->problem(), HasSubstr("its certificate 'anna' is valid only from 20"));
}

TEST_F(Handshake, ACertificateOfAnotherAuthorityIsRefused) {
  const Issued foreign = issue({.common_name = "anna"}, &other_authority_);
  connect(*good({}), *careless(&foreign));
  shake_hands();
  EXPECT_EQ(far_->problem(), "its certificate 'anna' is of another authority, 'other authority'");
  EXPECT_EQ(near_->problem(),
            "it refuses the certificate of this side: it is of another authority");
}

TEST_F(Handshake, AnAuthorityThatOnlyBearsTheNameIsRefused) {
  const Issued false_authority = make_authority();
  const Issued forged = issue({.common_name = "operator"}, &false_authority);
  connect(*good({}), *careless(&forged));
  shake_hands();
  EXPECT_EQ(far_->problem(),
            "its certificate 'operator' is not signed by the authority that it names");
}

TEST_F(Handshake, ACertificateThatSignsItselfIsRefused) {
  const Issued own = issue({.common_name = "anna"}, nullptr);
  connect(*good({}), *careless(&own));
  shake_hands();
  EXPECT_EQ(far_->problem(), "its certificate 'anna' is signed by itself, not by the authority");
}

TEST_F(Handshake, ACertificateThatNamesNobodyIsRefused) {
  const Issued nobody = issue({.common_name = "anna berta", .names = ""}, &authority_);
  connect(*good({}), *careless(&nobody));
  shake_hands();
  EXPECT_THAT(far_->problem(), HasSubstr("its certificate has no common name"));
  EXPECT_EQ(far_->identity(), "");
}

TEST_F(Handshake, ACertificateForAnotherUseIsRefused) {
  const Issued server = issue({.common_name = "anna", .usage = "serverAuth"}, &authority_);
  connect(*good({}), *careless(&server));
  shake_hands();
  EXPECT_EQ(far_->problem(), "its certificate 'anna' is not for clients (extendedKeyUsage)");
}

TEST_F(Handshake, ACertificateForAnotherAddressIsRefusedByWhoDials) {
  connect(*good({.names = "IP:192.168.1.5,DNS:robot.example"}), *good({}));
  shake_hands();
  EXPECT_EQ(near_->problem(),
            "its certificate 'robot' is not for '127.0.0.1', but for 192.168.1.5, robot.example");
  EXPECT_THAT(far_->problem(), HasSubstr("it refuses the certificate of this side"));
}

TEST_F(Handshake, ACertificateForAnotherNameIsRefusedByWhoDials) {
  connect(*good({.names = "DNS:robot.example"}), *good({}),
          {"tls", "127.0.0.1", 0, "other.example"});
  shake_hands();
  EXPECT_EQ(near_->problem(),
            "its certificate 'robot' is not for 'other.example', but for robot.example");
}

TEST_F(Handshake, TheNameThatWasDialledIsTaken) {
  connect(*good({.names = "DNS:robot.example"}), *good({}),
          {"tls", "127.0.0.1", 0, "robot.example"});
  near_->establish();
  while (far_->establish() != Progress::kDone) ASSERT_NE(near_->establish(), Progress::kGone);
  EXPECT_EQ(near_->establish(), Progress::kDone);
}

TEST_F(Handshake, TheCommonNameAloneIsNoNameToDial) {
  connect(*good({.common_name = "robot.example", .names = ""}), *good({}),
          {"tls", "127.0.0.1", 0, "robot.example"});
  shake_hands();
  EXPECT_EQ(near_->problem(),
            "its certificate 'robot.example' is not for 'robot.example', but for nothing");
}

TEST_F(Handshake, AServerOfAnotherAuthorityIsRefusedByWhoDials) {
  const Issued foreign = issue({}, &other_authority_);
  connect(*careless(&foreign), *good({}));
  shake_hands();
  EXPECT_EQ(near_->problem(), "its certificate 'robot' is of another authority, 'other authority'");
}

TEST_F(Handshake, AnExpiredServerIsRefusedByWhoDials) {
  const Issued old = issue({.from_s = -7200, .until_s = -3600}, &authority_);
  connect(*careless(&old), *good({}));
  shake_hands();
  EXPECT_THAT(near_->problem(), HasSubstr("its certificate 'robot' expired on 20"));
}

TEST_F(Handshake, WhoSpeaksOnlyOlderTlsIsRefused) {
  const Issued own = issue({}, &authority_);
  const ContextPointer old = careless(&own);
  SSL_CTX_set_max_proto_version(old.get(), TLS1_2_VERSION);
  connect(*good({}), *old);
  shake_hands();
  EXPECT_EQ(far_->problem(), "it does not speak TLS 1.3");
}

TEST_F(Handshake, WhatIsNotTlsIsNamedSo) {
  const ContextPointer server = good({});
  for (const char* const bytes :
       {"RIDE\x01\x02\x03\x04 and more", "GET / HTTP/1.1\r\n\r\n", "\x01\x02\x03\x04\x05\x06"}) {
    answer_with(bytes, *server);
    EXPECT_EQ(far_->problem(), "what it sent is not TLS") << bytes;
  }
}

TEST_F(Handshake, WhatOnlyBeginsLikeTlsIsRefused) {
  const ContextPointer server = good({});
  const std::vector<std::string> all{std::string("\x16\x03\x01\xff\xff", 5) + std::string(100, 'x'),
                                     std::string("\x16\x03\x01\x00\x04\x01\x00\x00\x00", 9),
                                     std::string("\x16\x03\x01\x00\x08\x02\xff\xff\xff....", 13)};
  for (const std::string& bytes : all) {
    answer_with(bytes, *server);
    EXPECT_FALSE(far_->problem().empty());
  }
}

TEST_F(Handshake, AnEndInTheMiddleIsToldAsOne) {
  const ContextPointer server = good({});
  auto stranger = dial();
  far_ = TlsConnection::accepted(accept(), *server);
  EXPECT_EQ(far_->establish(), Progress::kWantRead);
  stranger.reset();
  wait_until_readable(far_->handle());
  EXPECT_EQ(far_->establish(), Progress::kGone);
  EXPECT_EQ(far_->problem(), "it ended the connection before the handshake was done");
}

TEST_F(Handshake, AHandshakeByteAfterByteWaitsForEach) {
  const ContextPointer server = good({});
  const auto stranger = dial();
  far_ = TlsConnection::accepted(accept(), *server);
  while (stranger->finish_connect() == StreamStatus::kLater) {
  }
  for (const char byte : {'\x16', '\x03', '\x01', '\x02', '\x00', '\x01', '\x00', '\x01', '\xfc'}) {
    std::size_t sent = 0;
    ASSERT_EQ(stranger->send(std::as_bytes(std::span(&byte, 1)), sent), StreamStatus::kDone);
    wait_until_readable(far_->handle());
    EXPECT_EQ(far_->establish(), Progress::kWantRead);
  }
}

}  // namespace
}  // namespace armature::tls::internal
