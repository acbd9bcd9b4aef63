// SPDX-License-Identifier: Apache-2.0
// Pages over TLS: what a browser of another machine sees of them, by OpenSSL alone.
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include "armature/websocket/internal/pages.hpp"
#include "armature/websocket/internal/server.hpp"
#include "armature/websocket/internal/test_page.hpp"
#include "armature/websocket/internal/test_site.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::websocket {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

template <auto kFree>
struct Free {
  void operator()(auto* object) const { kFree(object); }
};

/// A connection as a browser makes it, which takes the certificate as it is.
class Browser {
 public:
  explicit Browser(std::uint16_t port, int version = TLS1_3_VERSION)
      : context_(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_min_proto_version(context_.get(), version);
    SSL_CTX_set_max_proto_version(context_.get(), version);
    constexpr std::string_view kPreferred = "\x02h2\x08http/1.1";
    SSL_CTX_set_alpn_protos(context_.get(),
                            reinterpret_cast<const unsigned char*>(kPreferred.data()),
                            static_cast<unsigned>(kPreferred.size()));
    bio_.reset(BIO_new_ssl_connect(context_.get()));
    BIO_set_conn_hostname(bio_.get(), ("127.0.0.1:" + std::to_string(port)).c_str());
    connected_ = BIO_do_connect(bio_.get()) == 1 && BIO_do_handshake(bio_.get()) == 1;
  }

  bool connected() const { return connected_; }
  void send(const std::string& text) {
    ASSERT_EQ(BIO_write(bio_.get(), text.data(), static_cast<int>(text.size())),
              static_cast<int>(text.size()));
  }
  /// What comes until it has `end` in it, or the connection ends.
  std::string read_until(const std::string& end) {
    std::string all;
    std::vector<char> room(1 << 14);
    while (all.find(end) == std::string::npos) {
      const int size = BIO_read(bio_.get(), room.data(), static_cast<int>(room.size()));
      if (size <= 0) break;
      all.append(room.data(), static_cast<std::size_t>(size));
    }
    return all;
  }

 private:
  std::unique_ptr<SSL_CTX, Free<SSL_CTX_free>> context_;
  std::unique_ptr<BIO, Free<BIO_free_all>> bio_;
  bool connected_ = false;
};

class Encrypted : public ::testing::Test {
 protected:
  Encrypted() {
    options_.pages = site_.folder();
    certify("robot", "-addext subjectAltName=DNS:Robot.lab,IP:127.0.0.1,IP:0:0:0:0:0:0:0:1");
  }

  /// Files of which the certificate has signed itself.
  void certify(const std::string& name, const std::string& more) {
    options_.certificate = site_.folder() + "/../" + name + ".pem";
    options_.key = site_.folder() + "/../" + name + ".key";
    const std::string command =
        "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj "
        "/CN=robot " +
        more + " -keyout " + options_.key + " -out " + options_.certificate + " 2>/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  /// Listens where every machine finds it.
  void serve() {
    base::Diagnostics diagnostics;
    transport_ = make_transport(options_, diagnostics);
    ASSERT_NE(transport_, nullptr) << diagnostics.to_text();
    EXPECT_TRUE(diagnostics.empty()) << diagnostics.to_text();
    auto listener = transport_->listen({"wss", "0.0.0.0", 0});
    ASSERT_TRUE(listener) << listener.error();
    listener_ = std::move(listener).value();
    port_ = listener_->address().port;
    token_ = transport_->pages().front();
    token_ = token_.substr(token_.find('#') + 1);
  }

  std::string host() const { return "robot.lab:" + std::to_string(port_); }
  std::string get(const std::string& path, const std::string& host) const {
    Browser browser(port_);
    if (!browser.connected()) return "no connection";
    browser.send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n");
    return browser.read_until("no such thing");
  }
  /// The cookie that the token is exchanged for.
  std::string pass() const {
    Browser browser(port_);
    browser.send("POST /token HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: https://" + host() +
                 "\r\nAuthorization: Bearer " + token_ + "\r\nContent-Length: 0\r\n\r\n");
    const std::string answer = browser.read_until("\r\n\r\n");
    const std::size_t begin = answer.find("set-cookie: ");
    if (begin == std::string::npos) return answer;
    return answer.substr(begin + 12, answer.find("\r\n", begin) - begin - 12);
  }

  internal::Site site_;
  Options options_;
  std::shared_ptr<Transport> transport_;
  std::unique_ptr<ride::Listener> listener_;
  std::uint16_t port_ = 0;
  std::string token_;
};

TEST_F(Encrypted, ServesPagesToAllMachinesByTheNamesOfTheCertificate) {
  serve();
  EXPECT_EQ(transport_->scheme(), "wss");
  EXPECT_TRUE(transport_->safe({"wss", "0.0.0.0", 1}));
  EXPECT_EQ(transport_->pages(), std::vector{"https://" + host() + "/#" + token_});
  EXPECT_THAT(get("/", host()), HasSubstr("<p>first</p>"));
  EXPECT_THAT(get("/", "127.0.0.1:" + std::to_string(port_)), HasSubstr("<p>first</p>"));
  EXPECT_THAT(get("/", "[::1]:" + std::to_string(port_)), HasSubstr("<p>first</p>"));
}

TEST_F(Encrypted, AnotherNameGetsNothing) {
  serve();
  const std::string answer = get("/", "evil.example:" + std::to_string(port_));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer, Not(HasSubstr("first")));
}

TEST_F(Encrypted, WhoDoesNotEncryptGetsNothing) {
  serve();
  internal::RawVisitor visitor(port_);
  ASSERT_TRUE(visitor.send("GET / HTTP/1.1\r\nHost: " + host() + "\r\n\r\n"));
  EXPECT_THAT(visitor.read_to_end(), Not(HasSubstr("first")));
  EXPECT_TRUE(visitor.ended());
}

TEST_F(Encrypted, OlderProtocolsAreRefused) {
  serve();
  EXPECT_FALSE(Browser(port_, TLS1_2_VERSION).connected());
  EXPECT_TRUE(Browser(port_, TLS1_3_VERSION).connected());
}

TEST_F(Encrypted, ThePassGoesNowhereElse) {
  serve();
  EXPECT_THAT(pass(), HasSubstr("; HttpOnly; SameSite=Strict; Path=/; Secure"));
}

TEST_F(Encrypted, CarriesTheSocketOfAPageBothWays) {
  serve();
  const std::string cookie = pass();
  Browser browser(port_);
  browser.send("GET / HTTP/1.1\r\nHost: " + host() +
               "\r\nUpgrade: websocket\r\nConnection: " + "Upgrade\r\nOrigin: https://" + host() +
               "\r\nCookie: " + cookie.substr(0, cookie.find(';')) +
               "\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
               "Sec-WebSocket-Version: 13\r\n\r\n");
  EXPECT_THAT(browser.read_until("\r\n\r\n"), StartsWith("HTTP/1.1 101"));
  std::unique_ptr<ride::Connection> connection;
  while (connection == nullptr) connection = listener_->accept();
  browser.send(internal::frame(2, "from the page"));
  std::vector<std::byte> room(64);
  std::size_t size = 0;
  ASSERT_EQ(connection->wait_and_receive(room, size, internal::kPatience), ride::Progress::kDone);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(room.data()), size), "from the page");
  const std::string answer = "from the node";
  ASSERT_EQ(connection->send(std::as_bytes(std::span(answer)), size), ride::Progress::kDone);
  EXPECT_THAT(browser.read_until(answer), HasSubstr(answer));
}

TEST_F(Encrypted, FilesThatCannotDoAreRefusedBeforeAnythingListens) {
  const auto mistakes = [&] {
    base::Diagnostics diagnostics;
    EXPECT_EQ(make_transport(options_, diagnostics), nullptr);
    return diagnostics.to_text();
  };
  const std::string key = options_.key;
  certify("nameless", "");
  EXPECT_THAT(mistakes(), HasSubstr("for no name and no address"));
  certify("everybody", "-addext 'subjectAltName=DNS:*.lab'");
  EXPECT_THAT(mistakes(), HasSubstr("for no name and no address"));
  options_.key = key;
  EXPECT_THAT(mistakes(), HasSubstr("the key does not fit the certificate"));
  options_.key = "/nowhere.key";
  EXPECT_THAT(mistakes(), HasSubstr("the key cannot be read"));
}

}  // namespace
}  // namespace armature::websocket
