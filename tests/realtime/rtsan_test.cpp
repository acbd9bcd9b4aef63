// SPDX-License-Identifier: Apache-2.0
// RealtimeSanitizer watches the loop: it ends the process when a component does in its update what
// a real-time thread must not do. That good components pass is shown by the other tests here, which
// the same build runs.
#include <cstdlib>
#include <mutex>

#include <gtest/gtest.h>

#include "armature/component/component.hpp"
#include "armature/exec/application.hpp"
#include "armature/rt/guard.hpp"

namespace armature::exec {
namespace {

using component::Component;
using std::chrono::milliseconds;

class Allocating final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override {
    void* volatile memory = std::malloc(40);
    std::free(memory);
  }
};

class Locking final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { const std::lock_guard lock(mutex_); }
  std::mutex mutex_;
};

/// Allocates where it may: before it starts and when it stops, and with permission.
class Careful final : public Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    allocate();
    return component::accepted();
  }
  void on_update() override {
    const rt::PermitScope permit;
    allocate();
  }
  void on_stop() override { allocate(); }
  void allocate() {
    void* volatile memory = std::malloc(40);
    std::free(memory);
  }
};

template <typename ComponentClass>
void run(bool simulated) {
  Blueprint blueprint;
  blueprint.add<ComponentClass>("component", Activity::periodic(milliseconds(1)));
  ApplicationOptions options;
  options.simulated = simulated;
  Application application(std::move(blueprint), std::move(options));
  ASSERT_TRUE(application.start().ok());
  while (application.thread_statistics().front().cycles_run < 3) {
    application.run_for(milliseconds(1));
  }
  application.stop();
}

/// In real time, or in simulated time.
class RealtimeSanitizer : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};
using RealtimeSanitizerDeathTest = RealtimeSanitizer;

INSTANTIATE_TEST_SUITE_P(Time, RealtimeSanitizer, ::testing::Bool());
INSTANTIATE_TEST_SUITE_P(Time, RealtimeSanitizerDeathTest, ::testing::Bool());

TEST_P(RealtimeSanitizerDeathTest, CatchesAnAllocationInAnUpdate) {
  EXPECT_DEATH(run<Allocating>(GetParam()), "RealtimeSanitizer: unsafe-library-call");
}

TEST_P(RealtimeSanitizerDeathTest, CatchesALockInAnUpdate) {
  EXPECT_DEATH(run<Locking>(GetParam()), "RealtimeSanitizer: unsafe-library-call");
}

TEST_P(RealtimeSanitizer, LetsPassWhatIsPermitted) { run<Careful>(GetParam()); }

}  // namespace
}  // namespace armature::exec
