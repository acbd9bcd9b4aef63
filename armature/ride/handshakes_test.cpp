// SPDX-License-Identifier: Apache-2.0
// A transport whose handshakes take long to compute.
#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/internal/node_rig.hpp"
#include "armature/ride/transport.hpp"

namespace armature::ride {
namespace {

using namespace std::chrono_literals;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Handshakes wait here until they are let go.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void wait_until_one_waits() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_ != 0; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0;
  bool open_ = false;
};

class SlowConnection final : public Connection {
 public:
  SlowConnection(std::unique_ptr<Connection> plain, Gate& gate)
      : plain_(std::move(plain)), gate_(gate) {}

  int handle() const override { return plain_->handle(); }
  Progress establish() override {
    gate_.pass();
    return plain_->establish();
  }
  bool establishes_slowly() const override { return true; }
  Progress send(std::span<const std::byte> bytes, std::size_t& sent) override {
    return plain_->send(bytes, sent);
  }
  Progress receive(std::span<std::byte> room, std::size_t& size) override {
    return plain_->receive(room, size);
  }
  Progress wait_and_receive(std::span<std::byte> room, std::size_t& size,
                            base::Duration limit) override {
    return plain_->wait_and_receive(room, size, limit);
  }
  void shut_down() override { plain_->shut_down(); }
  std::string other_end() const override { return plain_->other_end(); }
  std::string problem() const override { return plain_->problem(); }

 private:
  std::unique_ptr<Connection> plain_;
  Gate& gate_;
};

class SlowListener final : public Listener {
 public:
  SlowListener(std::unique_ptr<Listener> plain, Gate& gate)
      : plain_(std::move(plain)), gate_(gate) {}

  int handle() const override { return plain_->handle(); }
  std::unique_ptr<Connection> accept() override {
    auto accepted = plain_->accept();
    return accepted ? std::make_unique<SlowConnection>(std::move(accepted), gate_) : nullptr;
  }
  const Address& address() const override { return plain_->address(); }

 private:
  std::unique_ptr<Listener> plain_;
  Gate& gate_;
};

class SlowTransport final : public Transport {
 public:
  explicit SlowTransport(Gate& gate) : gate_(gate) {}

  std::string scheme() const override { return "slow"; }
  bool safe(const Address& address) const override { return plain_->safe(address); }
  base::Result<std::unique_ptr<Listener>> listen(const Address& address) override {
    return std::unique_ptr<Listener>(
        std::make_unique<SlowListener>(std::move(plain_->listen(address)).value(), gate_));
  }
  base::Result<std::unique_ptr<Connection>> connect(const Address& address) override {
    return plain_->connect(address);
  }

 private:
  std::unique_ptr<Transport> plain_ = make_tcp_transport();
  Gate& gate_;
};

class SlowHandshakeTest : public NodeTest {
 protected:
  ~SlowHandshakeTest() override {
    gate_.open();
    node_.reset();
  }

  /// Of one whose handshake goes on.
  RawClient slow_client() {
    options_.transports.push_back(std::make_shared<SlowTransport>(gate_));
    serve();
    RawClient made(node_->listen("slow://127.0.0.1:0").value());
    gate_.wait_until_one_waits();
    return made;
  }

  static void expect_service(RawClient& client) {
    client.send({}, Type::kControl, 0, Control{Code::kPing, 0, 0, 0, ""});
    EXPECT_EQ(client.receive_control().code, Code::kPong);
  }

  Gate gate_;
};

TEST_F(SlowHandshakeTest, HoldsUpNobodyElse) {
  auto slow = slow_client();
  auto other = client();
  expect_service(other);
  gate_.open();
  expect_service(slow);
}

TEST_F(SlowHandshakeTest, ThatDoesNotEndInTimeIsToldOnceItHasEnded) {
  options_.limits.time_to_complete = 1ms;
  auto slow = slow_client();
  EXPECT_FALSE(slow.receive().has_value());
  EXPECT_EQ(node_->statistics().connections, 1u) << "it is not forgotten while a thread has it";
  gate_.open();
  while (node_->statistics().connections != 0) std::this_thread::yield();
  const auto lines = log();
  EXPECT_EQ(std::ranges::count_if(
                lines, [](const auto& line) { return line.find("in time") != line.npos; }),
            1);
  EXPECT_THAT(lines, Contains(HasSubstr("was refused: the handshake did not end in time")));
}

}  // namespace
}  // namespace armature::ride
