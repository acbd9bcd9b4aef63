// SPDX-License-Identifier: Apache-2.0
// Nodes over TLS: a policy, and whatever comes to an open port.
#include "armature/ride/node.hpp"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/placeholder.hpp"
#include "armature/ride/policy.hpp"
#include "armature/ride/service.hpp"
#include "armature/testing/kept_port.hpp"
#include "armature/tls/internal/test_certificates.hpp"

namespace armature::tls {
namespace {

using namespace std::chrono_literals;
using internal::Folder;
using internal::issue;
using internal::Issued;
using platform::StreamListener;
using platform::StreamSocket;
using platform::StreamStatus;
using ride::Access;
using ride::Code;
using ::testing::HasSubstr;

constexpr ride::CallOptions kPatient{.deadline = 20s, .priority = {}};

struct Blink {
  std::int32_t count = 0;
};
void encode(ride::Encoder& to, const Blink& blink) { to.put(blink.count); }
bool decode(ride::Decoder& from, Blink& blink) { return from.take(blink.count); }
constexpr ride::Number event_number(const Blink*) { return ride::number_of("event Blink{int}"); }

constexpr ride::Declaration kLampDeclarations[] = {
    {"String echo(String)", Access::kRead},
    {"void light()"},
    {"event Blink{int}", Access::kRead},
};
constexpr ride::Interface kLamp{"Lamp", kLampDeclarations};
constexpr ride::Number kEcho = kLampDeclarations[0].number();
constexpr ride::Number kLight = kLampDeclarations[1].number();

class Lamp : public ride::Service {
 public:
  Lamp() : Service(kLamp) {}
  void blink(std::int32_t count) { publish(Blink{count}); }
  std::atomic<int> lit{0};

 private:
  ride::Executed execute(ride::Number operation, ride::Decoder& parameters,
                         ride::Reply& reply) override {
    std::string text;
    if (operation == kEcho && parameters.take(text) && parameters.ended()) {
      reply.put(text);
    } else if (operation == kLight && parameters.ended()) {
      ++lit;
      reply.done();
    } else {
      return ride::Executed::kMalformed;
    }
    return ride::Executed::kDone;
  }
};

class RemoteLamp : public ride::Placeholder {
 public:
  explicit RemoteLamp(ride::Peer& peer) : Placeholder(connected(peer), "Lamp", kLamp) {}
  ride::Answer<std::string> echo(const std::string& text) {
    return request<std::string>(kEcho, "echo", kPatient, text);
  }
  ride::Sent light() { return command(kLight, {}); }
  ride::Subscription on_blink(std::function<void(const Blink&)> handler) {
    return subscribe<Blink>(std::move(handler));
  }

 private:
  static ride::Peer& connected(ride::Peer& peer) {
    const auto done = peer.wait_until_connected(20s);
    EXPECT_TRUE(done.ok()) << (done ? "" : done.error());
    return peer;
  }
};

/// What a node tells, for a test to wait for.
class Log {
 public:
  std::function<void(const rt::LogRecord&)> sink() {
    return [this](const rt::LogRecord& record) {
      const std::lock_guard lock(mutex_);
      text_ += record.message() + "\n";
      grown_.notify_all();
    };
  }
  ::testing::AssertionResult tells(const std::string& what) {
    std::unique_lock lock(mutex_);
    if (grown_.wait_for(lock, 20s, [&] { return text_.find(what) != std::string::npos; })) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "'" << what << "' is not in:\n" << text_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable grown_;
  std::string text_;
};

class TlsNode : public ::testing::Test {
 protected:
  /// Of its own authority, unless another is given.
  std::shared_ptr<ride::Transport> transport(const internal::Wish& wish,
                                             const Issued* authority = nullptr) {
    const Issued& signer = authority != nullptr ? *authority : authority_;
    return internal::transport_of(
        folder_.write(wish.common_name, issue(wish, &signer), authority_));
  }

  void serve(const std::string& policy = "allow operator@tls read,command Lamp") {
    base::Diagnostics diagnostics;
    server_options_.allows = [policy = ride::Policy::parse(policy, "policy", diagnostics)](
                                 const ride::AccessQuestion& question) {
      return policy.allows(question);
    };
    ASSERT_TRUE(diagnostics.empty()) << diagnostics.to_text();
    server_options_.log = server_log_.sink();
    server_options_.transports.push_back(transport({}));
    server_.emplace(server_options_);
    ASSERT_TRUE(server_->add("Lamp", lamp_).ok());
    const auto got = server_->listen(port_.address("tls"));
    ASSERT_TRUE(got.ok()) << got.error();
    address_ = got.value();
  }

  ride::Peer& dial_as(const std::string& name, const Issued* authority = nullptr) {
    client_options_.transports = {transport({.common_name = name}, authority)};
    return dial();
  }
  ride::Peer& dial() {
    client_options_.reconnection.first = 1ms;
    client_options_.log = client_log_.sink();
    client_.emplace(client_options_);
    return client_->connect(address_.text());
  }

  /// A connection of one who has no idea of TLS.
  std::unique_ptr<StreamSocket> stranger() const {
    auto socket = std::move(StreamSocket::connect_tcp(address_.host, address_.port)).value();
    while (socket->finish_connect() == StreamStatus::kLater) {
    }
    return socket;
  }
  static void send(StreamSocket& to, const std::string& bytes) {
    std::size_t sent = 0;
    ASSERT_EQ(to.send(std::as_bytes(std::span(bytes)), sent), StreamStatus::kDone);
  }
  /// Waits for the end.
  static void read_to_the_end(StreamSocket& from) {
    std::byte room[64];
    std::size_t size = 0;
    while (from.wait_and_receive(room, size, 1h) == StreamStatus::kDone) {
    }
  }
  void the_operator_is_served() {
    RemoteLamp lamp(dial_as("operator"));
    const auto answer = lamp.echo("hello");
    ASSERT_TRUE(answer.ok()) << answer.error();
    EXPECT_EQ(answer.value(), "hello");
  }

  Folder folder_;
  Issued authority_ = internal::make_authority();
  Issued other_authority_ = internal::make_authority("other authority");
  Log server_log_;
  Log client_log_;
  Lamp lamp_;
  ride::NodeOptions server_options_;
  ride::NodeOptions client_options_;
  const testing::KeptPort port_;
  ride::Address address_;
  std::optional<ride::Node> server_;
  std::optional<ride::Node> client_;
};

TEST_F(TlsNode, WhoMayOnlyReadReadsAndItsCommandsAreNotExecuted) {
  serve("allow *@tls read Lamp\nallow operator@tls command Lamp");
  {
    RemoteLamp lamp(dial_as("guest"));
    EXPECT_EQ(lamp.light(), ride::Sent::kYes);
    EXPECT_EQ(lamp.echo("seen").value(), "seen");  // Behind the command, on the same connection.
    EXPECT_EQ(lamp_.lit, 0);
    EXPECT_TRUE(server_log_.tells(
        "(guest) was refused a COMMAND: NOT_ALLOWED (guest@tls may not command 'Lamp')"));
    EXPECT_TRUE(client_log_.tells("NOT_ALLOWED"));
  }
  RemoteLamp lamp(dial_as("operator"));
  EXPECT_EQ(lamp.light(), ride::Sent::kYes);
  EXPECT_EQ(lamp.echo("seen").value(), "seen");
  EXPECT_EQ(lamp_.lit, 1);
}

TEST_F(TlsNode, WhoIsInNoRuleMayNothing) {
  serve();
  RemoteLamp lamp(dial_as("guest"));
  EXPECT_EQ(lamp.echo("hello").code(), Code::kNotAllowed);
  EXPECT_THAT(lamp.echo("hello").error(), HasSubstr("guest@tls may not read 'Lamp'"));
}

TEST_F(TlsNode, WithoutAPolicyItListensToThisMachineOnly) {
  ride::NodeOptions options;
  options.transports.push_back(transport({}));
  ride::Node node(options);
  EXPECT_THAT(node.listen("tls://0.0.0.0:0").error(), HasSubstr("a policy"));
  EXPECT_TRUE(node.listen("tls://127.0.0.1:0").ok());
  options.allows = [](const ride::AccessQuestion&) { return false; };
  EXPECT_TRUE(ride::Node(options).listen("tls://0.0.0.0:0").ok());
}

TEST_F(TlsNode, LargeBodiesGoBothWays) {
  serve();
  RemoteLamp lamp(dial_as("operator"));
  for (const std::size_t size :
       {std::size_t{16'384}, std::size_t{65'519}, std::size_t{3'000'000}}) {
    const std::string large(size, 'x');
    const auto answer = lamp.echo(large);
    ASSERT_TRUE(answer.ok()) << answer.error();
    EXPECT_TRUE(answer.value() == large) << size;
  }
}

TEST_F(TlsNode, CallsOfManyThreadsAndEventsShareAConnection) {
  serve();
  RemoteLamp lamp(dial_as("operator"));
  constexpr int kCalls = 200;
  std::mutex mutex;
  std::condition_variable last_seen;
  std::int32_t last = 0;
  const auto told = lamp.on_blink([&](const Blink& blink) {
    const std::lock_guard lock(mutex);
    last = blink.count;
    last_seen.notify_all();
  });
  ASSERT_TRUE(lamp.echo("the subscription is in place").ok());
  std::vector<std::thread> callers;
  std::atomic<int> right{0};
  for (const char* const name : {"a", "b", "c"}) {
    callers.emplace_back([&, name] {
      for (int i = 0; i < kCalls; ++i) {
        const std::string text = name + std::to_string(i);
        const auto answer = lamp.echo(text);
        right += answer.ok() && answer.value() == text ? 1 : 0;
      }
    });
  }
  for (std::int32_t i = 1; i <= kCalls; ++i) lamp_.blink(i);
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(right, 3 * kCalls);
  std::unique_lock lock(mutex);
  EXPECT_TRUE(last_seen.wait_for(lock, 20s, [&] { return last == kCalls; })) << last;
}

TEST_F(TlsNode, AServerThatComesBackIsConnectedToAgain) {
  serve();
  RemoteLamp lamp(dial_as("operator"));
  ASSERT_TRUE(lamp.echo("before").ok());
  server_.reset();
  EXPECT_TRUE(client_log_.tells("lost tls://"));
  server_.emplace(server_options_);
  ASSERT_TRUE(server_->add("Lamp", lamp_).ok());
  ASSERT_TRUE(server_->listen(address_.text()).ok());
  ASSERT_TRUE(client_->connect(address_.text()).wait_until_connected(20s).ok());
  EXPECT_TRUE(lamp.echo("after").ok());
}

TEST_F(TlsNode, ACertificateOfAnotherAuthorityIsRefusedAndBothSidesSayWhy) {
  serve();
  ride::Peer& peer = dial_as("operator", &other_authority_);
  EXPECT_TRUE(server_log_.tells(
      "was refused: its certificate 'operator' is of another authority, 'other authority'"));
  EXPECT_TRUE(client_log_.tells(
      "cannot be reached: it refuses the certificate of this side: it is of another authority"));
  EXPECT_FALSE(peer.connected());
  EXPECT_GE(server_->statistics().connections_refused, 1u);
}

TEST_F(TlsNode, WhatIsNotTlsIsRefusedAndTheNodeStaysUp) {
  serve();
  for (const char* const bytes : {"RIDE\x07\x00", "GET / HTTP/1.1\r\n\r\n", "\xff\xff\xff\xff"}) {
    const auto socket = stranger();
    send(*socket, bytes);
    read_to_the_end(*socket);
  }
  EXPECT_TRUE(server_log_.tells("was refused: what it sent is not TLS"));
  the_operator_is_served();
  EXPECT_EQ(server_->statistics().connections_refused, 3u);
}

TEST_F(TlsNode, APlainClientAtATlsPortIsNeverConnected) {
  serve();
  address_.scheme = "tcp";
  ride::Peer& peer = dial();
  EXPECT_TRUE(server_log_.tells("was refused: what it sent is not TLS"));
  EXPECT_TRUE(client_log_.tells("cannot be reached"));
  EXPECT_FALSE(peer.connected());
}

TEST_F(TlsNode, ATlsClientAtAPlainPortSaysThatThereIsNoTls) {
  ride::NodeOptions options;
  options.log = server_log_.sink();
  ride::Node plain(options);
  address_ = plain.listen("tcp://127.0.0.1:0").value();
  address_.scheme = "tls";
  dial_as("operator");
  EXPECT_TRUE(client_log_.tells("cannot be reached: what it sent is not TLS"));
  EXPECT_TRUE(server_log_.tells("the data is not a RIDE message: it does not begin with 'RIDE'"));
}

TEST_F(TlsNode, AHandshakeThatDoesNotEndIsEnded) {
  server_options_.limits.time_to_complete = 20ms;
  serve();
  const auto silent = stranger();
  const auto slow = stranger();
  send(*slow, "\x16");
  read_to_the_end(*silent);
  read_to_the_end(*slow);
  EXPECT_TRUE(server_log_.tells("was refused: the handshake did not end in time"));
}

TEST_F(TlsNode, AServerThatNeverAnswersIsGivenUp) {
  const auto silent = std::move(StreamListener::listen_tcp("127.0.0.1", 0)).value();
  address_ = {"tls", "127.0.0.1", silent->port()};
  client_options_.limits.time_to_complete = 20ms;
  dial_as("operator");
  EXPECT_TRUE(client_log_.tells("cannot be reached: the handshake did not end in time"));
}

TEST_F(TlsNode, ManyHalfOpenHandshakesKeepNobodyOut) {
  server_options_.limits.connections = 4;
  server_options_.limits.time_to_complete = 1h;
  serve();
  std::vector<std::unique_ptr<StreamSocket>> half_open;
  for (int i = 0; i < 50; ++i) {
    half_open.push_back(stranger());
    send(*half_open.back(), "\x16\x03\x01");
  }
  the_operator_is_served();
  EXPECT_TRUE(
      server_log_.tells("was refused: newer connections came before its handshake was done"));
  EXPECT_LE(server_->statistics().connections, 4u);
  EXPECT_EQ(server_->statistics().connections_refused, 47u);
}

}  // namespace
}  // namespace armature::tls
