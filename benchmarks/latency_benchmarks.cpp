// SPDX-License-Identifier: Apache-2.0
// How late a 1 kHz thread wakes up, beside cyclictest, and whether every period is accounted for.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"
#include "benchmarks/allocations.hpp"
#include "benchmarks/cyclictest.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 1.15;
constexpr base::Duration kPeriod = std::chrono::milliseconds(1);
constexpr int kPriority = 80;
/// Short turns over minutes: what disturbs the machine for seconds is in both.
constexpr int kSlices = 45;
constexpr base::Duration kSlice = std::chrono::seconds(2);
constexpr base::Duration kQuickSlice = std::chrono::milliseconds(200);

/// Notes when each of its cycles began.
class Waker final : public component::Component {
 public:
  using Component::Component;
  void make_room(std::size_t cycles) { begins_.resize(cycles); }
  /// @thread any
  std::size_t count() const { return count_; }
  const std::vector<base::Time>& begins() const { return begins_; }

 private:
  void on_update() override {
    const std::size_t at = count_;
    if (at == begins_.size()) return;
    begins_[at] = time();
    count_ = at + 1;
  }
  std::vector<base::Time> begins_;
  std::atomic<std::size_t> count_{0};
};

/// What several runs of the periodic component, and of the reference beside it, showed.
struct Outcome {
  std::vector<double> latencies_ns;
  std::vector<double> reference_ns;
  std::uint64_t cycles = 0;
  std::uint64_t allocations = 0;
  double unaccounted = 0.0;  ///< periods that were neither run nor skipped, or both
};

/// The application's account of `waker` at a moment between two cycles.
exec::ThreadStatistics account_of(const exec::Application& application, const Waker& waker) {
  while (true) {
    for (exec::ThreadStatistics& thread : application.thread_statistics()) {
      const std::uint64_t seen = waker.count();
      if (thread.name == waker.name() && thread.cycles_run == seen &&
          thread.latency_ns.count == seen) {
        return thread;
      }
    }
    platform::sleep_until(platform::monotonic_now() + kPeriod / 10);
  }
}

/// The account keeps only the distribution of the latencies; each follows from when its cycle began
/// and from when the first period did. What does not add up is a fault.
void settle(const exec::ThreadStatistics& account, const Waker& waker, base::Time start,
            Outcome& outcome) {
  base::Time due = start + kPeriod;
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < account.cycles_run; ++i) {
    const base::Duration late = waker.begins()[i] - due;
    if (late < base::Duration::zero()) throw std::runtime_error("a cycle began before it was due");
    outcome.latencies_ns.push_back(static_cast<double>(late.count()));
    total += static_cast<std::uint64_t>(late.count());
    due += (late / kPeriod + 1) * kPeriod;
  }
  if (total != account.latency_ns.total) {
    throw std::runtime_error("the engine's latencies are not those of its cycles");
  }
  const base::Time last = waker.begins()[account.cycles_run - 1];
  const auto periods = static_cast<double>((last - start) / kPeriod);
  outcome.unaccounted += periods - static_cast<double>(account.cycles_run + account.cycles_skipped);
  outcome.cycles += account.cycles_run;
}

bool got_fifo(const exec::Application& application, const std::string& thread) {
  const auto& lines = application.verdict().lines;
  return std::any_of(lines.begin(), lines.end(), [&](const exec::Verdict::Line& line) {
    return line.subject == thread && line.granted.find("SCHED_FIFO") != std::string::npos;
  });
}

/// @return whether the thread got the real-time priority that it asked for
bool run_ours(base::Duration slice, Outcome& outcome) {
  exec::Blueprint blueprint;
  Waker& waker = blueprint.add<Waker>("Waker", exec::Activity::periodic(kPeriod, kPriority));
  waker.make_room(2 * static_cast<std::size_t>(slice / kPeriod));
  exec::ApplicationOptions options;
  options.realtime = exec::RealtimeMode::kPrefer;
  exec::Application application(std::move(blueprint), options);
  const base::Diagnostics started = application.start();
  if (!started.ok()) throw std::runtime_error(started.to_text());
  const base::Time start = waker.time();  // until the first cycle begins
  const std::uint64_t before = allocations();
  application.run_for(slice);
  outcome.allocations += allocations() - before;
  const exec::ThreadStatistics account = account_of(application, waker);
  application.stop();
  // Looked too late, when a cycle had begun already: there is no telling when the first was due.
  if (start >= waker.begins().front()) return run_ours(slice, outcome);
  settle(account, waker, start, outcome);
  return got_fifo(application, waker.name());
}

std::vector<double> run_reference(base::Duration slice, int priority) {
  static const bool cyclictest = cyclictest_runs(priority);
  if (cyclictest) return run_cyclictest(kPeriod, slice, priority);
  std::printf("cyclictest does not run: a loop that sleeps until absolute times stands in\n");
  return run_sleeping_loop(kPeriod, slice, priority);
}

Outcome run_slices(int slices, base::Duration slice) {
  Outcome outcome;
  for (int i = 0; i < slices; ++i) {
    const int priority = run_ours(slice, outcome) ? kPriority : 0;
    const std::vector<double> reference = run_reference(slice, priority);
    outcome.reference_ns.insert(outcome.reference_ns.end(), reference.begin(), reference.end());
  }
  std::sort(outcome.latencies_ns.begin(), outcome.latencies_ns.end());
  std::sort(outcome.reference_ns.begin(), outcome.reference_ns.end());
  return outcome;
}

double percentile_us(const std::vector<double>& sorted_ns, double percent) {
  const double last = static_cast<double>(sorted_ns.size() - 1);
  return sorted_ns[static_cast<std::size_t>(percent / 100.0 * last)] / 1000.0;
}

/// All entries look at the same run, which the first of them makes.
class SharedRun {
 public:
  explicit SharedRun(bool quick) : quick_(quick) {}
  const Outcome& outcome() {
    if (!outcome_) outcome_ = quick_ ? run_slices(1, kQuickSlice) : run_slices(kSlices, kSlice);
    return *outcome_;
  }

 private:
  bool quick_;
  std::optional<Outcome> outcome_;
};

Result latency(const Outcome& outcome, double percent) {
  return {percentile_us(outcome.latencies_ns, percent), "us",
          percentile_us(outcome.reference_ns, percent),
          static_cast<double>(outcome.allocations) / static_cast<double>(outcome.cycles),
          ratio_at_most(kBound)};
}

Result unaccounted(const Outcome& outcome) {
  return {outcome.unaccounted, "periods", std::nullopt,
          static_cast<double>(outcome.allocations) / static_cast<double>(outcome.cycles),
          value_at_most(0.0)};
}

void add(const Suite& suite, const std::string& name, const std::shared_ptr<SharedRun>& run,
         const std::function<Result(const Outcome&)>& result) {
  suite.add(name, 1, [=](benchmark::State& state) {
    for ([[maybe_unused]] auto round : state) publish(state, result(run->outcome()));
  });
}

}  // namespace

void add_latency(const Suite& suite) {
  const auto run = std::make_shared<SharedRun>(suite.quick());
  for (const auto& [name, percent] : {std::pair("p50", 50.0), {"p99", 99.0}, {"p99.9", 99.9}}) {
    add(suite, std::string("latency_1khz/") + name, run,
        [percent = percent](const Outcome& outcome) { return latency(outcome, percent); });
  }
  add(suite, "periods_exact", run, unaccounted);
}

}  // namespace armature::benchmarks
