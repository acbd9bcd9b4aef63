// SPDX-License-Identifier: Apache-2.0
// An event to many processes, beside bare sockets that send as many bytes to as many.
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "armature/ride/node.hpp"
#include "benchmarks/audience.hpp"
#include "benchmarks/bare_socket.hpp"
#include "benchmarks/on_cpu.hpp"
#include "benchmarks/suite.hpp"
#include "remote_client.hpp"
#include "remote_service.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kRounds = 101;
constexpr std::chrono::milliseconds kBatch(10);
constexpr double kBound = 1.0;
constexpr std::uint32_t kProcesses = 16;
constexpr std::size_t kEvent = 16 + 4 + 8;

class Wheels final : public remote::WheelsService {
 public:
  std::int32_t setVelocity(float, float) override { return 0; }
  std::int32_t setAll(const std::vector<double>&) override { return 0; }
  void drive(float, float) override {}
  void turn() { raise(remote::Turned{0.5}); }
};

/// What a process does that has subscribed.
void subscribe(Audience::Hall& hall) {
  ride::Node node;
  ride::Peer& peer = node.connect("tcp://127.0.0.1:" + std::to_string(hall.wait_for_port()));
  remote::WheelsPlaceholder wheels(peer, "Wheels");
  if (!peer.wait_until_connected(std::chrono::seconds(10))) return;
  const auto subscription = wheels.on_Turned([&](const remote::Turned&) { hall.heard(); });
  if (!wheels.setVelocity(0.5f, 0.5f).ok()) return;  // The subscription is there.
  hall.heard();
  pause();
}

/// What a process does that has a bare socket.
void receive(Audience::Hall& hall) {
  const auto socket = bare_connection(hall.wait_for_port());
  hall.heard();
  while (socket->receive(kEvent)) hall.heard();
}

/// A component whose event goes to processes.
class Publisher {
 public:
  explicit Publisher(int cpu) : audience_(kProcesses, cpu, subscribe) {
    node_ = std::make_unique<ride::Node>();
    if (!node_->add("Wheels", wheels_)) throw std::runtime_error("cannot be added");
    const auto address = node_->listen("tcp://127.0.0.1:0");
    if (!address) throw std::runtime_error(address.error());
    audience_.hall().open(address.value().port);
    audience_.hall().wait_until_all_have_heard();
  }
  void run(std::int64_t count) {
    for (; count > 0; --count) {
      wheels_.turn();
      audience_.hall().wait_until_all_have_heard();
    }
  }

 private:
  Audience audience_;
  Wheels wheels_;
  std::unique_ptr<ride::Node> node_;
};

class BarePublisher {
 public:
  explicit BarePublisher(int cpu) : audience_(kProcesses, cpu, receive) {
    BareListener listener;
    audience_.hall().open(listener.port());
    for (std::uint32_t i = 0; i < kProcesses; ++i) sockets_.push_back(listener.accept());
    audience_.hall().wait_until_all_have_heard();
  }
  void run(std::int64_t count) {
    for (; count > 0; --count) {
      for (const auto& socket : sockets_) socket->send(kEvent);
      audience_.hall().wait_until_all_have_heard();
    }
  }

 private:
  Audience audience_;
  std::vector<std::unique_ptr<BareSocket>> sockets_;
};

void event(benchmark::State& state, int cpu_of_subscribers) {
  const OnCpu here(0);
  BarePublisher bare(cpu_of_subscribers);  // The first: its processes are to have one thread.
  Publisher publisher(cpu_of_subscribers);
  Result result = measure_in_turn(
      state, [&](std::int64_t count) { publisher.run(count); },
      [&](std::int64_t count) { bare.run(count); }, kBatch);
  result.bound = ratio_at_most(kBound);
  publish(state, result);
}

}  // namespace

void add_fan_outs(const Suite& suite) {
  suite.add("remote_event/16_processes/one_cpu", kRounds,
            [](benchmark::State& state) { event(state, 0); });
  if (std::thread::hardware_concurrency() == 1) return;
  suite.add("remote_event/16_processes/two_cpus", kRounds,
            [](benchmark::State& state) { event(state, 1); });
}

}  // namespace armature::benchmarks
