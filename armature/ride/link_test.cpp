// SPDX-License-Identifier: Apache-2.0
// A connection that has to write before it can be read, and one that callers read.
#include "armature/ride/internal/link.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/platform/clock.hpp"
#include "armature/platform/sockets/stream_socket.hpp"
#include "armature/ride/internal/node/node_state.hpp"
#include "armature/ride/internal/raw_client.hpp"
#include "armature/ride/internal/test_vision.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {
namespace {

using platform::StreamListener;
using platform::StreamSocket;
using platform::StreamStatus;

/// Before it receives it has an answer of its own to send, as TLS has to a request for new keys.
class OwesAnAnswer final : public Connection {
 public:
  OwesAnAnswer(std::unique_ptr<StreamSocket> socket, int& receives)
      : socket_(std::move(socket)), receives_(receives) {}

  int handle() const override { return socket_->handle(); }
  Progress establish() override { return Progress::kDone; }
  Progress send(std::span<const std::byte>, std::size_t&) override { return Progress::kWantWrite; }
  Progress receive(std::span<std::byte> room, std::size_t& size) override {
    ++receives_;
    std::size_t sent = 0;
    const std::byte answer{};
    if (socket_->send(std::span(&answer, 1), sent) != StreamStatus::kDone) {
      return Progress::kWantWrite;
    }
    return socket_->receive(room, size) == StreamStatus::kDone ? Progress::kDone
                                                               : Progress::kWantRead;
  }
  Progress wait_and_receive(std::span<std::byte> room, std::size_t& size, base::Duration) override {
    return receive(room, size);
  }
  void shut_down() override { socket_->shut_down(); }
  std::string other_end() const override { return "test"; }
  std::string problem() const override { return ""; }

 private:
  std::unique_ptr<StreamSocket> socket_;
  int& receives_;
};

class LinkTest : public testing::Test {
 protected:
  LinkTest() {
    // Its buffers are exact: what the other side has acknowledged makes no room by itself.
    const std::string path = testing::TempDir() + "ride_link_" + std::to_string(::getpid());
    const auto listener = std::move(StreamListener::listen_file(path)).value();
    near_ = std::move(StreamSocket::connect_file(path)).value();
    far_ = listener->accept();
    while (near_->finish_connect() == StreamStatus::kLater) {
    }
  }

  /// Until the other side would have to read first.
  static void fill(StreamSocket& socket) {
    const std::byte byte{};
    std::size_t sent = 0;
    while (socket.send(std::span(&byte, 1), sent) == StreamStatus::kDone) {
    }
  }
  static void drain(StreamSocket& socket) {
    std::vector<std::byte> room(64 * 1024);
    std::size_t size = 0;
    while (socket.receive(room, size) == StreamStatus::kDone) {
    }
  }
  void step(int times) {
    for (int i = 0; i < times; ++i) state_.step({});
  }

  std::unique_ptr<StreamSocket> near_;
  std::unique_ptr<StreamSocket> far_;
  internal::NodeState state_{NodeOptions{}};
  int receives_ = 0;
};

/// A connection of a node that a test drives, and what is at its other end.
class LinkOfACallerTest : public testing::Test {
 protected:
  static constexpr base::Duration kTime = std::chrono::milliseconds(50);

  LinkOfACallerTest() {
    const auto transport = make_tcp_transport();
    const auto listener = std::move(transport->listen({"tcp", "127.0.0.1", 0})).value();
    other_.emplace(listener->address());
    std::unique_ptr<Connection> accepted;
    while (!accepted) accepted = listener->accept();
    link_ = state_.adopt(std::move(accepted), "tcp");
    step(std::chrono::milliseconds(1));
  }
  static NodeOptions options() {
    NodeOptions options;
    options.limits.time_to_complete = kTime;
    return options;
  }
  void step(base::Duration how_long) {
    const base::Time end = platform::monotonic_now() + how_long;
    do {
      state_.step(std::chrono::milliseconds(1));
    } while (platform::monotonic_now() < end);
  }
  /// A thread asks, and gets its answer once `meanwhile` is done.
  template <typename Meanwhile>
  void call(const Meanwhile& meanwhile) {
    std::int32_t result = 0;
    const Place place(result);
    internal::WaitingCall call(place);
    std::thread caller([&] {
      const std::tuple<> none;
      link_->call(kNote, internal::Recipient(1),
                  {.deadline = std::chrono::seconds(20), .priority = {}}, Fields(none), call);
    });
    const auto request = other_->receive().value_or(RawClient::Received{});
    meanwhile();
    Decoder from(request.body);
    Number operation = 0;
    std::uint32_t id = 0;
    EXPECT_TRUE(from.take(operation) && from.take(id));
    other_->send({}, Type::kReply, id, std::int32_t{7});
    caller.join();
    EXPECT_EQ(result, 7);
  }
  bool answers() {
    bool answered = false;
    std::thread asking([&] {
      other_->send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
      answered = other_->receive_control().code == Code::kPong;
      done_ = true;
    });
    const base::Time end = platform::monotonic_now() + std::chrono::seconds(10);
    while (!done_ && platform::monotonic_now() < end) step(std::chrono::milliseconds(1));
    if (!done_) link_->break_off("it does not answer");
    asking.join();
    return answered;
  }

  internal::NodeState state_{options()};
  std::optional<RawClient> other_;
  std::shared_ptr<internal::Link> link_;
  std::atomic<bool> done_{false};
};

TEST_F(LinkOfACallerTest, IsReadAgainIfItListenedWhenTheCallBeganAndDoesNoMore) {
  link_->set_listens(true);
  call([&] { link_->set_listens(false); });
  EXPECT_TRUE(answers());
}

TEST_F(LinkOfACallerTest, IsNotLateWithAMessageOfWhichACallerHasReadTheRest) {
  const Body ping = RawClient::message({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
  other_->send(ping.bytes().first(10));
  while (link_->incomplete_since == base::Time::max()) step({});
  call([&] { other_->send(ping.bytes().subspan(10)); });
  step(2 * kTime);
  EXPECT_EQ(link_->problem(), "");
}

TEST_F(LinkTest, IsNotReadWhileItHasToWriteFirst) {
  fill(*far_);
  std::size_t sent = 0;
  ASSERT_EQ(near_->send(std::as_bytes(std::span("RIDE", 4)), sent), StreamStatus::kDone);
  state_.adopt(std::make_unique<OwesAnAnswer>(std::move(far_), receives_), "test");
  step(10);
  EXPECT_EQ(receives_, 1);
  for (int i = 0; i < 2000 && receives_ == 1; ++i) {
    drain(*near_);
    state_.step(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(receives_, 2) << "it is read when it can write";
  ASSERT_EQ(near_->send(std::as_bytes(std::span("RIDE", 4)), sent), StreamStatus::kDone);
  step(2);
  EXPECT_EQ(receives_, 3) << "and from then on";
}

}  // namespace
}  // namespace armature::ride
