// SPDX-License-Identifier: Apache-2.0
// Requests, commands and events over TCP on this machine, beside bare sockets that send as many
// bytes. Where threads run changes a round trip threefold, so both sides are told.
#include <cstdint>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <sched.h>

#include "armature/ride/node.hpp"
#include "benchmarks/bare_socket.hpp"
#include "benchmarks/baton.hpp"
#include "benchmarks/on_cpu.hpp"
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

struct Ends {
  std::unique_ptr<BareSocket> client;
  std::unique_ptr<BareSocket> server;
};

Ends connected_pair() {
  BareListener listener;
  Ends ends;
  ends.client = bare_connection(listener.port());
  ends.server = listener.accept();
  return ends;
}

/// A thread that answers so many bytes with so many.
class BarePingPong {
 public:
  BarePingPong(std::size_t request, std::size_t reply, int server_cpu)
      : request_(request), reply_(reply), ends_(connected_pair()) {
    const OnCpu there(server_cpu);
    thread_ = std::thread([this] { bare_answer(*ends_.server, request_, reply_); });
  }
  ~BarePingPong() {
    ends_.client.reset();
    thread_.join();
  }
  void run(std::int64_t count) { bare_ask(*ends_.client, count, request_, reply_); }

 private:
  std::size_t request_;
  std::size_t reply_;
  Ends ends_;
  std::thread thread_;
};

/// A thread that takes any number of bytes.
class BareStream {
 public:
  explicit BareStream(int server_cpu) : ends_(connected_pair()) {
    const OnCpu there(server_cpu);
    thread_ = std::thread([this] { bare_swallow(*ends_.server); });
  }
  ~BareStream() {
    ends_.client.reset();
    thread_.join();
  }
  void run(std::int64_t bytes) { bare_pour(*ends_.client, bytes); }

 private:
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
class Subscribers {
 public:
  Subscribers(Pair& pair, std::size_t size) : size_(size), pair_(pair) {
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
  Subscribers sixteen(many, kSubscribers);
  Subscribers single(one, 1);
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
