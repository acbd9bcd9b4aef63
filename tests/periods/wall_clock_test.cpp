// SPDX-License-Identifier: Apache-2.0
// An application runs while somebody sets the wall clock. This program's own clock functions stand
// in for the system's: the wall clock that they show jumps by an hour at each look.
#include <atomic>
#include <chrono>
#include <ctime>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/platform/clock.hpp"

namespace {

std::atomic<int> looks_at_wall_clock{0};
std::atomic<int> looks_at_monotonic_clock{0};

std::time_t jump() {
  const int look = ++looks_at_wall_clock;
  return look % 2 == 0 ? 3600 * look : -3600 * look;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const auto status = static_cast<int>(syscall(SYS_clock_gettime, clock, now));
  if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) now->tv_sec += jump();
  if (clock == CLOCK_MONOTONIC) ++looks_at_monotonic_clock;
  return status;
}

int gettimeofday(timeval* now, void*) noexcept {
  timespec fine{};
  clock_gettime(CLOCK_REALTIME, &fine);
  *now = {fine.tv_sec, fine.tv_nsec / 1000};
  return 0;
}

time_t time(time_t* result) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}

}  // extern "C"

namespace armature::exec {
namespace {

using namespace std::chrono_literals;

/// Writes down at which times its cycles ran, and looks at the wall clock as a user's code may.
class Diary final : public component::Component {
 public:
  explicit Diary(std::string name) : Component(std::move(name)) { times.reserve(10000); }
  std::vector<base::Time> times;

 private:
  void on_update() override {
    static_cast<void>(platform::wall_clock_text());
    if (times.size() < times.capacity()) times.push_back(time());
  }
};

TEST(WallClock, ItsStepsChangeNothing) {
  Blueprint blueprint;
  Diary& diary = blueprint.add<Diary>("Diary", Activity::periodic(2ms));
  Application application(std::move(blueprint));
  ASSERT_TRUE(application.start().ok());
  application.run_for(200ms);
  ASSERT_TRUE(application.stop().ok());

  EXPECT_GT(looks_at_monotonic_clock, 0) << "the libraries do not use this program's clock";
  EXPECT_GT(looks_at_wall_clock, 1) << "the wall clock did not jump";
  ASSERT_GT(diary.times.size(), 1u);
  for (std::size_t i = 1; i < diary.times.size(); ++i) {
    const base::Duration step = diary.times[i] - diary.times[i - 1];
    EXPECT_GT(step, 0ms);
    EXPECT_LT(step, 1min) << "far more than a busy machine makes of it";
  }
  const ThreadStatistics statistics = application.thread_statistics().front();
  EXPECT_GE(statistics.cycles_run, diary.times.size());
  EXPECT_LT(statistics.cycles_run + statistics.cycles_skipped, 30000u) << "a minute's cycles";
}

}  // namespace
}  // namespace armature::exec
