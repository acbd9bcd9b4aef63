// SPDX-License-Identifier: Apache-2.0
// Requests, commands and events over TCP on this machine, beside bare sockets that send as many
// bytes. Where threads run changes a round trip threefold, so both sides are told.
#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include "armature/ride/node.hpp"
#include "benchmarks/baton.hpp"
#include "benchmarks/suite.hpp"
#include "remote_client.hpp"
#include "remote_service.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kRounds = 101;
constexpr std::chrono::milliseconds kBatch(5);
constexpr double kRoundTripBound = 1.10;
constexpr double kSubscribersBound = 1.5;
constexpr double kCommandBound_ns = 200.0;  // 5 million a second
constexpr std::size_t kSubscribers = 16;
constexpr std::size_t kVelocities = 128;

void check(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

/// This thread, and those that it starts, run on one CPU; as before when the scope ends.
class OnCpu {
 public:
  explicit OnCpu(int cpu) {
    check(sched_getaffinity(0, sizeof before_, &before_) == 0, "sched_getaffinity");
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(cpu), &one);
    check(sched_setaffinity(0, sizeof one, &one) == 0, "sched_setaffinity");
  }
  OnCpu(const OnCpu&) = delete;
  OnCpu& operator=(const OnCpu&) = delete;
  ~OnCpu() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_;
};

/// One side of a connection with nothing around it.
class BareSocket {
 public:
  explicit BareSocket(int socket) : socket_(socket) {
    check(socket >= 0, "socket");
    const int on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  }
  BareSocket(const BareSocket&) = delete;
  BareSocket& operator=(const BareSocket&) = delete;
  ~BareSocket() { close(socket_); }

  static constexpr std::size_t kRoom = 64 * 1024;

  int handle() const { return socket_; }
  /// A number at the beginning of what is sent or was received.
  void set_value(std::int64_t value) { std::memcpy(bytes_, &value, sizeof value); }
  std::int64_t value() const {
    std::int64_t value = 0;
    std::memcpy(&value, bytes_, sizeof value);
    return value;
  }
  void send(std::size_t size) {
    check(::send(socket_, bytes_, size, 0) == static_cast<ssize_t>(size), "send");
  }
  /// False when the other side is done.
  bool receive(std::size_t size) {
    for (std::size_t had = 0; had < size;) {
      const ssize_t got = recv(socket_, bytes_ + had, size - had, 0);
      if (got <= 0) return false;
      had += static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  int socket_;
  char bytes_[kRoom] = {};
};

struct Ends {
  std::unique_ptr<BareSocket> client;
  std::unique_ptr<BareSocket> server;
};

Ends connected_pair() {
  BareSocket listener(socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  check(bind(listener.handle(), any, size) == 0 && listen(listener.handle(), 1) == 0, "listen");
  check(getsockname(listener.handle(), any, &size) == 0, "getsockname");
  Ends ends;
  ends.client = std::make_unique<BareSocket>(socket(AF_INET, SOCK_STREAM, 0));
  check(connect(ends.client->handle(), any, size) == 0, "connect");
  ends.server = std::make_unique<BareSocket>(accept(listener.handle(), nullptr, nullptr));
  return ends;
}

/// Answers so many bytes with so many.
class BarePingPong {
 public:
  BarePingPong(std::size_t request, std::size_t reply, int server_cpu)
      : request_(request), reply_(reply), ends_(connected_pair()) {
    const OnCpu there(server_cpu);
    thread_ = std::thread([this] {
      while (ends_.server->receive(request_)) ends_.server->send(reply_);
    });
  }
  ~BarePingPong() {
    ends_.client.reset();
    thread_.join();
  }
  void run(std::int64_t count) {
    for (; count > 0; --count) {
      ends_.client->send(request_);
      if (!ends_.client->receive(reply_)) throw std::runtime_error("the bare server has gone");
    }
  }

 private:
  std::size_t request_;
  std::size_t reply_;
  Ends ends_;
  std::thread thread_;
};

/// Takes any number of bytes, and says so with one when it has them all.
class BareStream {
 public:
  explicit BareStream(int server_cpu) : ends_(connected_pair()) {
    const OnCpu there(server_cpu);
    thread_ = std::thread([this] {
      while (ends_.server->receive(sizeof(std::int64_t))) {
        std::int64_t left = ends_.server->value();
        while (left > 0) {
          const auto part = std::min<std::int64_t>(left, kChunk);
          if (!ends_.server->receive(static_cast<std::size_t>(part))) return;
          left -= part;
        }
        ends_.server->send(1);
      }
    });
  }
  ~BareStream() {
    ends_.client.reset();
    thread_.join();
  }
  void run(std::int64_t bytes) {
    ends_.client->set_value(bytes);
    ends_.client->send(sizeof bytes);
    for (std::int64_t left = bytes; left > 0; left -= kChunk) {
      ends_.client->send(static_cast<std::size_t>(std::min<std::int64_t>(left, kChunk)));
    }
    if (!ends_.client->receive(1)) throw std::runtime_error("the bare server has gone");
  }

 private:
  static constexpr std::int64_t kChunk = BareSocket::kRoom;
  Ends ends_;
  std::thread thread_;
};

class Wheels final : public remote::WheelsService {
 public:
  std::int32_t setVelocity(float left, float) override { return left > 0.0f ? 1 : 0; }
  std::int32_t setAll(const std::vector<double>& all) override {
    return static_cast<std::int32_t>(all.size());
  }
  void drive(float, float) override {}
  void turn() { raise(remote::Turned{0.5}); }
};

/// A node with wheels, and another that uses them.
class Pair {
 public:
  explicit Pair(int server_cpu) {
    {
      const OnCpu there(server_cpu);
      server_ = std::make_unique<ride::Node>();
    }
    const auto address = server_->listen("tcp://127.0.0.1:0");
    if (!address) throw std::runtime_error(address.error());
    if (!server_->add("Wheels", wheels)) throw std::runtime_error("cannot be added");
    peer_ = &client_.connect(address.value().text());
    placeholder_ = std::make_unique<remote::WheelsPlaceholder>(*peer_, "Wheels");
    const auto connected = peer_->wait_until_connected(std::chrono::seconds(5));
    if (!connected) throw std::runtime_error(connected.error());
  }
  remote::WheelsPlaceholder& placeholder() { return *placeholder_; }

  Wheels wheels;

 private:
  std::unique_ptr<ride::Node> server_;
  ride::Node client_;
  ride::Peer* peer_ = nullptr;
  std::unique_ptr<remote::WheelsPlaceholder> placeholder_;
};

void expect(const ride::Answer<std::int32_t>& answer, std::int32_t value) {
  if (!answer.ok()) throw std::runtime_error(answer.error());
  if (answer.value() != value) throw std::runtime_error("a wrong answer");
}

constexpr std::size_t kHeader = 16;
constexpr std::size_t kReply = kHeader + 4;
constexpr std::size_t kCommand = kHeader + 12;

void call(benchmark::State& state, int server_cpu) {
  const OnCpu here(0);
  Pair pair(server_cpu);
  BarePingPong bare(kHeader + 16, kReply, server_cpu);
  Result result = measure_in_turn(
      state,
      [&](std::int64_t count) {
        for (; count > 0; --count) expect(pair.placeholder().setVelocity(0.5f, -0.25f), 1);
      },
      [&](std::int64_t count) { bare.run(count); }, kBatch);
  result.bound = ratio_at_most(kRoundTripBound);
  publish(state, result);
}

void call_with_a_kibibyte(benchmark::State& state, int server_cpu) {
  const OnCpu here(0);
  Pair pair(server_cpu);
  BarePingPong bare(kHeader + 12 + 8 * kVelocities, kReply, server_cpu);
  const std::vector<double> velocities(kVelocities, 0.5);
  Result result = measure_in_turn(
      state,
      [&](std::int64_t count) {
        for (; count > 0; --count) {
          expect(pair.placeholder().setAll(velocities), static_cast<std::int32_t>(kVelocities));
        }
      },
      [&](std::int64_t count) { bare.run(count); }, kBatch);
  result.bound = ratio_at_most(kRoundTripBound);
  publish(state, result);
}

/// Commands as fast as they are taken, until all were executed; beside as many bytes in large
/// pieces.
void command(benchmark::State& state) {
  const OnCpu here(0);
  Pair pair(1);
  BareStream bare(1);
  ride::CallOptions patient;
  patient.deadline = std::chrono::seconds(60);
  Result result = measure_in_turn(
      state,
      [&](std::int64_t count) {
        for (; count > 0; --count) {
          while (pair.placeholder().drive(0.5f, -0.25f) != ride::Sent::kYes) sched_yield();
        }
        expect(pair.placeholder().setVelocity(0.5f, 0.5f, patient), 1);  // after all of them
      },
      [&](std::int64_t count) { bare.run(count * static_cast<std::int64_t>(kCommand)); },
      std::chrono::milliseconds(20));
  result.bound = value_at_most(kCommandBound_ns);
  publish(state, result);
}

/// Subscribers in this process, of whom the last tells that an event is there.
class Audience {
 public:
  Audience(Pair& pair, std::size_t size) : size_(size), pair_(pair) {
    for (std::size_t i = 0; i < size; ++i) {
      subscriptions_.push_back(
          pair.placeholder().on_Turned([this](const remote::Turned&) { count(); }));
    }
    expect(pair.placeholder().setVelocity(0.5f, 0.5f), 1);  // the subscription is there
  }
  void hear(std::int64_t count) {
    for (; count > 0; --count) {
      pair_.wheels.turn();
      all_.wait();
    }
  }

 private:
  void count() {
    if (++heard_ % size_ == 0) all_.pass();
  }

  std::size_t size_;
  Pair& pair_;
  std::size_t heard_ = 0;  ///< the node's thread's
  Baton all_;
  std::deque<ride::Subscription> subscriptions_;
};

void event(benchmark::State& state) {
  const OnCpu here(0);
  Pair many(1);
  Pair one(1);
  Audience sixteen(many, kSubscribers);
  Audience single(one, 1);
  Result result = measure_in_turn(
      state, [&](std::int64_t count) { sixteen.hear(count); },
      [&](std::int64_t count) { single.hear(count); }, kBatch);
  result.bound = ratio_at_most(kSubscribersBound);
  publish(state, result);
}

}  // namespace

void add_remote(const Suite& suite) {
  const bool two = std::thread::hardware_concurrency() > 1;
  for (const int server_cpu : two ? std::vector<int>{0, 1} : std::vector<int>{0}) {
    const std::string where = server_cpu == 0 ? "one_cpu" : "two_cpus";
    suite.add("remote_call/" + where, kRounds,
              [server_cpu](benchmark::State& state) { call(state, server_cpu); });
    suite.add("remote_call_1KiB/" + where, kRounds,
              [server_cpu](benchmark::State& state) { call_with_a_kibibyte(state, server_cpu); });
  }
  if (!two) return;
  suite.add("remote_command", kRounds, command);
  suite.add("remote_event/16", kRounds, event);
}

}  // namespace armature::benchmarks
