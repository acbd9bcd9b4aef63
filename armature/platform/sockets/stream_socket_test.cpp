// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/stream_socket.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform {
namespace {

class Streams : public testing::Test {
 protected:
  Streams() {
    const std::string path = testing::TempDir() + "stream_" + std::to_string(::getpid());
    const auto listener = std::move(StreamListener::listen_file(path)).value();
    near_ = std::move(StreamSocket::connect_file(path)).value();
    far_ = listener->accept();
    while (near_->finish_connect() == StreamStatus::kLater) {
    }
  }

  std::unique_ptr<StreamSocket> near_;
  std::unique_ptr<StreamSocket> far_;
};

TEST_F(Streams, SayWhyTheyAreGone) {
  far_.reset();
  std::array<std::byte, 8> room{};
  std::size_t size = 0;
  EXPECT_EQ(near_->receive(room, size), StreamStatus::kGone);
  EXPECT_EQ(near_->problem(), "the other side has ended it");
  EXPECT_EQ(near_->send(room, size), StreamStatus::kGone);
  EXPECT_EQ(near_->problem(), "Broken pipe");
}

TEST_F(Streams, HaveThePriorityThatTheyAreGiven) {
  const auto level = [&] {
    int found = -1;
    socklen_t size = sizeof found;
    ::getsockopt(near_->handle(), SOL_SOCKET, SO_PRIORITY, &found, &size);
    return found;
  };
  EXPECT_EQ(level(), 0);
  EXPECT_TRUE(near_->set_priority(6));
  EXPECT_EQ(level(), 6);
  EXPECT_TRUE(near_->set_priority(0));
  EXPECT_EQ(level(), 0);
}

// A race if the two shared anything else than the socket: the thread sanitizer sees it.
TEST_F(Streams, MayBeFoundGoneByWhoSendsAndWhoReceivesAtTheSameTime) {
  std::thread receiver([&] {
    std::array<std::byte, 8> room{};
    std::size_t size = 0;
    while (near_->wait_and_receive(room, size, std::chrono::seconds(20)) != StreamStatus::kGone) {
    }
    EXPECT_FALSE(near_->problem().empty());
  });
  far_.reset();
  const std::byte byte{};
  std::size_t sent = 0;
  while (near_->send(std::span(&byte, 1), sent) != StreamStatus::kGone) {
  }
  EXPECT_FALSE(near_->problem().empty());
  receiver.join();
}

// The system tries one port after the other for who connects: among so many attempts there is one
// from the port that is asked for.
TEST(StreamSocketOfTcp, IsNeverConnectedToItself) {
  constexpr int kAttempts = 15'000;
  // Who connects gets an even one as long as there are any.
  const auto port =
      static_cast<std::uint16_t>(StreamListener::listen_tcp("127.0.0.1", 0).value()->port() & ~1);
  int connected = 0;
  for (int i = 0; i < kAttempts; ++i) {
    const auto socket = StreamSocket::connect_tcp("127.0.0.1", port);
    if (!socket) continue;
    StreamStatus status = StreamStatus::kLater;
    while (status == StreamStatus::kLater) status = socket.value()->finish_connect();
    if (status == StreamStatus::kDone) ++connected;
  }
  EXPECT_EQ(connected, 0);
}

TEST(StreamSocketPair, IsConnectedAndEndsOnceAllItsHandlesAreClosed) {
  auto [near, far] = std::move(StreamSocket::make_pair("a page")).value();
  EXPECT_EQ(near->other_end(), "a page");
  EXPECT_EQ(near->finish_connect(), StreamStatus::kDone);
  const std::byte byte{7};
  std::size_t size = 0;
  ASSERT_EQ(near->send(std::span(&byte, 1), size), StreamStatus::kDone);
  std::byte got{};
  ASSERT_EQ(far->wait_and_receive(std::span(&got, 1), size, std::chrono::hours(1)),
            StreamStatus::kDone);
  EXPECT_EQ(got, byte);

  const int other = another_handle(near->handle());
  ASSERT_GE(other, 0);
  near.reset();
  EXPECT_EQ(far->receive(std::span(&got, 1), size), StreamStatus::kLater);
  { const internal::Descriptor closes(other); }
  EXPECT_EQ(far->receive(std::span(&got, 1), size), StreamStatus::kGone);
}

}  // namespace
}  // namespace armature::platform
