// SPDX-License-Identifier: Apache-2.0
// What a 1 kHz cycle notices of a flood of queries, as a task browser or a script can send them.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 1.05;
constexpr base::Duration kPeriod = std::chrono::milliseconds(1);
constexpr int kPriority = 80;
constexpr int kRounds = 5;
constexpr int kTurnsOfARound =
    24;  ///< of each: 6000 cycles, of which six are beyond the percentile
constexpr int kQuickTurns = 2;
constexpr base::Duration kTurn = std::chrono::milliseconds(250);
/// What happened before has no part in a turn.
constexpr base::Duration kPause = std::chrono::milliseconds(10);

/// Computes a little in each cycle, and notes when it began and was over.
class Busy final : public component::Component {
 public:
  using Component::Component;

  struct Cycle {
    base::Time begin;
    base::Time end;
  };
  void make_room(std::size_t cycles) { cycles_.resize(cycles); }
  /// @thread any
  std::size_t count() const { return count_; }
  const Cycle& cycle(std::size_t index) const { return cycles_[index]; }

 private:
  void on_update() override {
    constexpr int kSteps = 2000;
    double sum = value_;
    for (int i = 1; i <= kSteps; ++i) sum += std::sqrt(static_cast<double>(i)) * 1e-9;
    value_ = sum;
    position_.write(value_);
    const std::size_t at = count_;
    if (at == cycles_.size()) return;
    cycles_[at] = {time(), platform::monotonic_now()};
    count_ = at + 1;
  }

  component::OutputPort<double> position_{this, "Position", "what is asked for", "rad"};
  double value_ = 0.0;
  std::vector<Cycle> cycles_;
  std::atomic<std::size_t> count_{0};
};

double percentile_us(std::vector<double> times_ns) {
  if (times_ns.empty()) throw std::runtime_error("no cycle was run");
  std::sort(times_ns.begin(), times_ns.end());
  const double last = static_cast<double>(times_ns.size() - 1);
  return times_ns[static_cast<std::size_t>(0.999 * last)] / 1000.0;
}

/// One application, which is asked without a pause by turns.
class Flood {
 public:
  Flood(int rounds, int turns) : rounds_(rounds), turns_(turns) {
    exec::Blueprint blueprint;
    exec::Activity activity = exec::Activity::periodic(kPeriod, kPriority);
    if (std::thread::hardware_concurrency() > 1) activity.cpus = {1};
    busy_ = &blueprint.add<Busy>("Busy", activity);
    const base::Duration time = 2 * rounds * turns * (kTurn + kPause) + std::chrono::seconds(5);
    busy_->make_room(static_cast<std::size_t>(time / kPeriod));
    exec::ApplicationOptions options;
    options.realtime = exec::RealtimeMode::kPrefer;
    application_ = std::make_unique<exec::Application>(std::move(blueprint), options);
    const base::Diagnostics started = application_->start();
    if (!started.ok()) throw std::runtime_error(started.to_text());
    start_ = busy_->time();
  }

  /// Medians of the rounds; in a round the turns are so short that whatever disturbs the ones
  /// disturbs the others.
  Result run() {
    std::vector<double> with;
    std::vector<double> without;
    for (int round = 0; round < rounds_; ++round) {
      std::vector<double> asked;
      std::vector<double> left_alone;
      for (int i = 0; i < turns_; ++i) {
        const bool first = i % 2 == 0;
        take_turn(first, first ? asked : left_alone);
        take_turn(!first, first ? left_alone : asked);
      }
      with.push_back(percentile_us(asked));
      without.push_back(percentile_us(left_alone));
    }
    return {median(with), "us", median(without), std::nullopt, ratio_at_most(kBound)};
  }

 private:
  /// Adds the times from when a cycle was due until it was over.
  void take_turn(bool ask, std::vector<double>& times_ns) {
    application_->run_for(kPause);
    const std::size_t from = busy_->count();
    const base::Time end = platform::monotonic_now() + kTurn;
    if (!ask) application_->run_for(kTurn);
    while (ask && platform::monotonic_now() < end) {
      if (!application_->value_of("Busy", "Position")) throw std::runtime_error("no answer");
    }
    for (std::size_t i = from; i < busy_->count(); ++i) {
      const Busy::Cycle& cycle = busy_->cycle(i);
      const base::Duration late = (cycle.begin - start_) % kPeriod;
      times_ns.push_back(static_cast<double>((late + (cycle.end - cycle.begin)).count()));
    }
  }

  int rounds_;
  int turns_;
  Busy* busy_;
  std::unique_ptr<exec::Application> application_;
  base::Time start_;
};

}  // namespace

void add_queries(const Suite& suite) {
  const bool quick = suite.quick();
  suite.add("queries/p99.9", 1, [quick](benchmark::State& state) {
    for ([[maybe_unused]] auto round : state) {
      Flood flood(quick ? 1 : kRounds, quick ? kQuickTurns : kTurnsOfARound);
      publish(state, flood.run());
    }
  });
}

}  // namespace armature::benchmarks
