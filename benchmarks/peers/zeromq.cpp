// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <stdexcept>
#include <thread>

#include <zmq.h>

#include "benchmarks/peers/peer.hpp"

namespace armature::benchmarks::peers {
namespace {

enum class Kind : std::int32_t { kVelocity, kAll, kDrive };

struct Message {
  Kind kind;
  float left;
  float right;
};

struct LargeMessage {
  Kind kind;
  std::uint32_t count;
  double all[128];
};

void check(bool done) {
  if (!done) throw std::runtime_error(std::string("ZeroMQ: ") + zmq_strerror(zmq_errno()));
}

/// A socket of a context of its own. One pair of sockets keeps the order of commands and requests;
/// ZeroMQ sends without delay, and gathers what waits.
class Socket {
 public:
  Socket() {
    const int unlimited = 0;
    const int no_time = 0;
    check(zmq_setsockopt(socket_, ZMQ_SNDHWM, &unlimited, sizeof unlimited) == 0);
    check(zmq_setsockopt(socket_, ZMQ_RCVHWM, &unlimited, sizeof unlimited) == 0);
    check(zmq_setsockopt(socket_, ZMQ_LINGER, &no_time, sizeof no_time) == 0);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    zmq_close(socket_);
    zmq_ctx_term(context_);
  }
  void* get() const { return socket_; }
  template <typename T>
  void send(const T& message) {
    check(zmq_send(socket_, &message, sizeof message, 0) == static_cast<int>(sizeof message));
  }

 private:
  void* context_ = zmq_ctx_new();
  void* socket_ = zmq_socket(context_, ZMQ_PAIR);
};

class ZeroMqServer final : public Server {
 public:
  ZeroMqServer() {
    check(zmq_bind(socket_.get(), "tcp://127.0.0.1:*") == 0);
    thread_ = std::thread([this] { run(); });
    thread_.detach();  // It ends with the process.
  }
  std::string address() const override {
    char text[256] = "";
    std::size_t size = sizeof text;
    check(zmq_getsockopt(socket_.get(), ZMQ_LAST_ENDPOINT, text, &size) == 0);
    return text;
  }

 private:
  void run() {
    LargeMessage message{};
    while (zmq_recv(socket_.get(), &message, sizeof message, 0) > 0) {
      if (message.kind == Kind::kAll) socket_.send(peers::set_all(message.count));
      if (message.kind != Kind::kVelocity) continue;
      Message small{};
      std::memcpy(&small, &message, sizeof small);
      socket_.send(peers::set_velocity(small.left, small.right));
    }
  }

  Socket socket_;
  std::thread thread_;
};

class ZeroMqClient final : public Client {
 public:
  explicit ZeroMqClient(const std::string& address) {
    check(zmq_connect(socket_.get(), address.c_str()) == 0);
  }
  std::int32_t set_velocity(float left, float right) override {
    socket_.send(Message{Kind::kVelocity, left, right});
    return answer();
  }
  std::int32_t set_all(const std::vector<double>& all) override {
    LargeMessage message{Kind::kAll, static_cast<std::uint32_t>(all.size()), {}};
    std::memcpy(message.all, all.data(), sizeof message.all);
    socket_.send(message);
    return answer();
  }
  void drive(std::int64_t count) override {
    for (; count > 0; --count) socket_.send(Message{Kind::kDrive, 0.5f, -0.25f});
    set_velocity(0.5f, 0.5f);  // after all of them
  }

 private:
  std::int32_t answer() {
    std::int32_t result = 0;
    check(zmq_recv(socket_.get(), &result, sizeof result, 0) == static_cast<int>(sizeof result));
    return result;
  }

  Socket socket_;
};

}  // namespace

Peer zeromq() {
  return {"zeromq", [] { return std::make_unique<ZeroMqServer>(); },
          [](const std::string& address) { return std::make_unique<ZeroMqClient>(address); }};
}

}  // namespace armature::benchmarks::peers
