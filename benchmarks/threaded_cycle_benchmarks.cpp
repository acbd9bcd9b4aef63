// SPDX-License-Identifier: Apache-2.0
// The sampled-control cycle in four threads, beside the bare futex hops that its wiring needs, and
// beside these hops with the same components' work in one thread.
#include <algorithm>
#include <atomic>
#include <deque>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "armature/exec/application.hpp"
#include "armature/platform/thread.hpp"
#include "benchmarks/baton.hpp"
#include "benchmarks/control_cycle/comparison.hpp"
#include "benchmarks/control_cycle/cycle.hpp"
#include "benchmarks/control_cycle/monolithic.hpp"
#include "benchmarks/control_cycle/pacer.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr double kBound = 1.3;
constexpr std::int64_t kRounds = 101;
constexpr std::chrono::milliseconds kBatch(10);
/// What was measured last has to count, however long the machine takes.
constexpr std::chrono::seconds kLongestArming(10);
/// A controller does nothing before there is a reference.
constexpr std::chrono::milliseconds kUntilReference(100);

// Threads as a robot has them, ours and the reference's alike: real-time, and on one CPU, since one
// waits for the other. Where the kernel chooses, a hop on the same CPU takes a third of one between
// two, and each side finds its own mixture.
constexpr int kPriority = 50;

int last_cpu() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())) - 1; }

exec::Activity own_thread() {
  exec::Activity activity = exec::Activity::triggered(kPriority);
  activity.cpus = {last_cpu()};
  return activity;
}

platform::ThreadRequest bare_thread() {
  platform::ThreadRequest request;
  request.name = "bare hop";
  request.scheduler = platform::Scheduler::kFifo;
  request.priority = kPriority;
  request.cpus = {last_cpu()};
  return request;
}

/// Plain threads that wake each other as the cycle's do, and do nothing else. Five wake-ups: the
/// sampler's thread, in which the joints live, tells the actuator of `Sample` and hands the samples
/// to the sensor, this to the controller, this to the actuator, and this back to the joints.
class BareHops {
 public:
  BareHops() {
    const std::function<void()> bodies[] = {[this] { run_joints(); }, [this] { run_sensor(); },
                                            [this] { run_controller(); },
                                            [this] { run_actuator(); }};
    for (const auto& body : bodies) {
      threads_.emplace_back(bare_thread(), body);
    }
  }
  BareHops(const BareHops&) = delete;
  BareHops& operator=(const BareHops&) = delete;
  ~BareHops() {
    ending_ = true;
    for (Baton* baton : {&joints_, &sensor_, &controller_, &actuator_}) baton->pass();
  }

  void run_cycles(std::int64_t count) {
    left_ = count;
    joints_.pass();
    finish_.wait();
  }

 private:
  void run_joints() {
    while (true) {
      joints_.wait();
      if (ending_) return;
      for (; left_ > 0; --left_) {
        actuator_.pass();
        sensor_.pass();
        joints_.wait();
      }
      finish_.pass();
    }
  }
  void run_sensor() {
    while (true) {
      sensor_.wait();
      if (ending_) return;
      controller_.pass();
    }
  }
  void run_controller() {
    while (true) {
      controller_.wait();
      if (ending_) return;
      controlled_ = true;
      actuator_.pass();
    }
  }
  void run_actuator() {
    while (true) {
      actuator_.wait();
      if (ending_) return;
      if (controlled_.exchange(false)) joints_.pass();
    }
  }

  std::int64_t left_ = 0;
  Baton joints_;
  Baton sensor_;
  Baton controller_;
  Baton actuator_;
  Baton finish_;
  std::atomic<bool> controlled_{false};
  std::atomic<bool> ending_{false};
  std::deque<platform::Thread> threads_;  ///< joined first
};

/// What the threaded cycle is measured against.
enum class Beside { kHops, kHopsAndWork };

/// The same components in one thread.
class OneThread {
 public:
  explicit OneThread(int joints) : application_(make_cycle(joints, one_thread()), simulated()) {
    const base::Diagnostics started = application_.start();
    if (!started.ok()) throw std::runtime_error(started.to_text());
    run_cycles(10);
    arm(application_);
  }
  void run_cycles(std::int64_t count) { application_.run_for(std::chrono::milliseconds(count)); }

 private:
  exec::Application application_;
};

void run_cycle(benchmark::State& state, int joints, Beside beside) {
  exec::Blueprint blueprint =
      make_cycle(joints, {own_thread(), own_thread(), own_thread(), own_thread(), kLongestArming});
  Pacer& pacer = add_pacer(blueprint, joints);
  exec::ApplicationOptions options;
  options.realtime = exec::RealtimeMode::kPrefer;
  exec::Application application(std::move(blueprint), std::move(options));
  const base::Diagnostics started = application.start();
  if (!started.ok()) return state.SkipWithError(started.to_text().c_str());

  application.run_for(kUntilReference);
  pacer.run_cycles(1);
  application.run_for(kUntilReference);
  arm(application, [&] { pacer.run_cycles(1); });
  BareHops hops;
  std::optional<OneThread> work;
  if (beside == Beside::kHopsAndWork) work.emplace(joints);
  Result result = measure_in_turn(
      state, [&](std::int64_t count) { pacer.run_cycles(count); },
      [&](std::int64_t count) {
        hops.run_cycles(count);
        if (work) work->run_cycles(count);
      },
      kBatch);
  result.bound = ratio_at_most(kBound);
  publish(state, result);

  MonolithicController loop(joints);
  const std::string difference = difference_of(application, loop, joints);
  if (!difference.empty()) state.SkipWithError(difference.c_str());
}

}  // namespace

void add_threaded_cycles(const Suite& suite) {
  for (const int joints : {2, 7, 64, 256, 1000}) {
    const std::string number = std::to_string(joints);
    suite.add("cycle_threaded/" + number, kRounds,
              [joints](benchmark::State& state) { run_cycle(state, joints, Beside::kHops); });
    suite.add("cycle_threaded_with_work/" + number, kRounds, [joints](benchmark::State& state) {
      run_cycle(state, joints, Beside::kHopsAndWork);
    });
  }
}

}  // namespace armature::benchmarks
