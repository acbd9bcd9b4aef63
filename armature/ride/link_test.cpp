// SPDX-License-Identifier: Apache-2.0
// A connection that has to write before it can be read.
#include "armature/ride/internal/link.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "armature/platform/stream_socket.hpp"
#include "armature/ride/internal/node_state.hpp"
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
