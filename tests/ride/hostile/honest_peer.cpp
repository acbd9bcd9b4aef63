// SPDX-License-Identifier: Apache-2.0
// Who obeys the rules, beside those who do not. For each line on its standard input, a number, it
// sends so many pairs of requests and prints one line: p50 and p99 of the round trips [us], mean
// of the messages that the node has taken between the two of a pair, requests that failed, commands
// that were executed so far, events seen, steps back in the events' numbers.
//
// usage: ride_honest_peer ADDRESS [FOLDER_OF_CERTIFICATES]
#include <algorithm>
#include <atomic>
#include <chrono>

#include "armature/platform/clock.hpp"
#include "robot.hpp"

namespace {

using namespace hostile;
using namespace std::chrono_literals;

class RemoteRobot : public ride::Placeholder {
 public:
  explicit RemoteRobot(ride::Peer& peer) : Placeholder(peer, "robot", kRobot) {}
  ride::Answer<std::uint64_t> messages() {
    return request<std::uint64_t>(kMessages, "messages", kPatient);
  }
  ride::Answer<std::uint64_t> moves() { return request<std::uint64_t>(kMoves, "moves", kPatient); }
  ride::Subscription on_tick(std::function<void(const Tick&)> handler) {
    return subscribe<Tick>(std::move(handler));
  }

 private:
  static constexpr ride::CallOptions kPatient{.deadline = 5s, .priority = {}};
};

std::uint64_t part_of(std::vector<std::uint64_t>& values, double part) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

class Measurement {
 public:
  explicit Measurement(RemoteRobot& robot) : robot_(robot) {}

  void add_pair() {
    const std::uint64_t first = request();
    const std::uint64_t second = request();
    if (first == 0 || second == 0) return;
    between_ += second - first;
    ++pairs_;
  }
  std::uint64_t p50_ns() { return part_of(ns_, 0.5); }
  std::uint64_t p99_ns() { return part_of(ns_, 0.99); }
  std::uint64_t between() const { return pairs_ == 0 ? 0 : between_ / pairs_; }
  int failed() const { return failed_; }

 private:
  std::uint64_t request() {
    const auto begin = armature::platform::monotonic_now();
    const auto answer = robot_.messages();
    const auto took = armature::platform::monotonic_now() - begin;
    ns_.push_back(static_cast<std::uint64_t>(took.count()));
    if (!answer) ++failed_;
    return answer ? answer.value() : 0;
  }

  RemoteRobot& robot_;
  std::vector<std::uint64_t> ns_;
  std::uint64_t between_ = 0;
  std::uint64_t pairs_ = 0;
  int failed_ = 0;
};

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  ride::NodeOptions options;
  if (count > 2) options.transports = {tls_of(arguments[2], "operator")};
  ride::Node node(options);
  ride::Peer& peer = node.connect(arguments[1]);
  if (const auto there = peer.wait_until_connected(20s); !there) {
    std::fprintf(stderr, "%s\n", there.error().c_str());
    return 1;
  }
  RemoteRobot robot(peer);
  std::atomic<int> events{0};
  std::atomic<int> steps_back{0};
  std::int32_t last = 0;
  const auto told = robot.on_tick([&](const Tick& tick) {
    ++events;
    if (tick.number <= last) ++steps_back;
    last = tick.number;
  });
  for (int pairs = 0; std::scanf("%d", &pairs) == 1;) {
    Measurement measurement(robot);
    auto next = armature::platform::monotonic_now();
    for (int i = 0; i < pairs; ++i) {
      measurement.add_pair();
      armature::platform::sleep_until(next += 1ms);
    }
    const auto moves = robot.moves();
    std::printf("%.1f %.1f %llu %d %lld %d %d\n", static_cast<double>(measurement.p50_ns()) / 1e3,
                static_cast<double>(measurement.p99_ns()) / 1e3,
                static_cast<unsigned long long>(measurement.between()), measurement.failed(),
                moves ? static_cast<long long>(moves.value()) : -1, events.load(),
                steps_back.load());
    std::fflush(stdout);
  }
}
