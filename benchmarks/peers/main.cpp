// SPDX-License-Identifier: Apache-2.0
// Measures calls and commands over RIDE and over others' libraries, each beside bare sockets;
// benchmarks/README.md says what each entry is.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "benchmarks/on_cpu.hpp"
#include "benchmarks/peers/peer.hpp"
#include "benchmarks/peers/server_process.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/suite.hpp"

namespace {

using namespace armature::benchmarks;
using peers::Client;
using peers::Peer;

constexpr std::int64_t kRounds = 101;
constexpr std::chrono::milliseconds kBatch(5);
constexpr std::chrono::milliseconds kCommandBatch(20);
constexpr double kRoundTripBound = 1.10;
constexpr double kCommandBound_ns = 200.0;  // 5 million a second
constexpr std::size_t kVelocities = 128;

/// A client here and its server in a process of its own.
class Connected {
 public:
  Connected(const Peer& peer, int server_cpu)
      : server_(peer.name, server_cpu), client_(peer.connect(server_.address())) {}
  Client& operator*() { return *client_; }

 private:
  peers::ServerProcess server_;
  std::unique_ptr<Client> client_;
};

void expect(std::int32_t value, std::int32_t wanted) {
  if (value != wanted) throw std::runtime_error("a wrong answer");
}

using Measured = void (*)(Client& client, std::int64_t count);

void call(Client& client, std::int64_t count) {
  for (; count > 0; --count) expect(client.set_velocity(0.5f, -0.25f), 1);
}

void call_with_a_kibibyte(Client& client, std::int64_t count) {
  static const std::vector<double> velocities(kVelocities, 0.5);
  for (; count > 0; --count) {
    expect(client.set_all(velocities), static_cast<std::int32_t>(kVelocities));
  }
}

void command(Client& client, std::int64_t count) { client.drive(count); }

Result beside_raw(benchmark::State& state, const Peer& peer, int server_cpu, Measured measured,
                  std::chrono::microseconds batch) {
  const OnCpu here(0);
  Connected raw(peers::raw(), server_cpu);
  Connected connected(peer, server_cpu);
  return measure_in_turn(
      state, [&](std::int64_t count) { measured(*connected, count); },
      [&](std::int64_t count) { measured(*raw, count); }, batch);
}

void add_calls(const Suite& suite, const std::string& name, Measured measured) {
  const bool two = std::thread::hardware_concurrency() > 1;
  for (const int cpu : two ? std::vector<int>{0, 1} : std::vector<int>{0}) {
    const std::string where = cpu == 0 ? "/one_cpu/" : "/two_cpus/";
    for (const Peer& peer : peers::all_peers()) {
      suite.add(name + where + peer.name, kRounds, [=](benchmark::State& state) {
        Result result = beside_raw(state, peer, cpu, measured, kBatch);
        if (peer.name == "ride") result.bound = ratio_at_most(kRoundTripBound);
        publish(state, result);
      });
    }
  }
}

void add_commands(const Suite& suite) {
  if (std::thread::hardware_concurrency() == 1) return;
  for (const Peer& peer : peers::all_peers()) {
    suite.add("command/" + peer.name, kRounds, [=](benchmark::State& state) {
      Result result = beside_raw(state, peer, 1, command, kCommandBatch);
      if (peer.name == "ride") result.bound = value_at_most(kCommandBound_ns);
      publish(state, result);
    });
  }
}

int measure(const std::string& filter, bool quick, const std::string& json) {
  Report report;
  try {
    const Suite suite(filter, quick);
    add_calls(suite, "call", call);
    add_calls(suite, "call_1KiB", call_with_a_kibibyte);
    add_commands(suite);
  } catch (const std::regex_error& mistake) {
    std::fprintf(stderr, "armature_bench_peers: error: --filter %s: %s\n", filter.c_str(),
                 mistake.what());
    return 2;
  }
  if (benchmark::RunSpecifiedBenchmarks(&report) == 0) {
    std::fprintf(stderr, "armature_bench_peers: error: no entry's name contains '%s'\n",
                 filter.c_str());
    return 2;
  }
  const bool written = json.empty() || report.write_json(json);
  return report.complete() && written ? 0 : 1;
}

/// Ends with the process that started it.
int serve(const std::string& name) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::vector<Peer> known = peers::all_peers();
  known.push_back(peers::raw());
  const auto peer = std::ranges::find(known, name, &Peer::name);
  if (peer == known.end()) {
    std::fprintf(stderr, "armature_bench_peers: error: '%s' is no peer of this build\n",
                 name.c_str());
    return 2;
  }
  try {
    const auto server = peer->serve();
    std::printf("%s\n", server->address().c_str());
    std::fflush(stdout);
    for (;;) pause();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "armature_bench_peers: error: %s: %s\n", name.c_str(), failure.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options("Measures RIDE and others' libraries beside bare sockets.");
  std::string filter;
  std::string json;
  std::string served;
  bool quick = false;
  options.add_option("--json", json, "file that the entries are written to");
  options.add_option("--filter", filter, "regular expression: only entries whose name contains it");
  options.add_flag("--quick", quick, "few rounds: shows that everything runs, not how fast");
  options.add_option("--serve", served,
                     "only serves so-and-so: what this program starts itself as");
  CLI11_PARSE(options, argc, argv);
  return served.empty() ? measure(filter, quick, json) : serve(served);
}
