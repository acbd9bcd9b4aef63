// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/key.hpp"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// A key, and a clock that stands until it is told.
class Held : public ::testing::Test {
 protected:
  /// Renewed at each interval for so long.
  void hold(base::Duration time, base::Duration interval = 50ms) {
    key_.renew(now_);
    for (base::Duration passed{}; passed < time; passed += interval) {
      now_ += interval;
      key_.renew(now_);
    }
  }
  std::string use() {
    const auto used = key_.use(now_);
    return used ? "used" : used.error();
  }

  Key key_;
  base::Time now_{};
};

TEST_F(Held, ForASecondItLetsOneActThrough) {
  EXPECT_THAT(use(), HasSubstr("is not held"));
  hold(950ms);
  EXPECT_THAT(use(), HasSubstr("held for 0.9"));
  hold(50ms);
  EXPECT_EQ(use(), "used");
  hold(2s);
  EXPECT_THAT(use(), HasSubstr("let go of it"));
  key_.release();
  EXPECT_THAT(use(), HasSubstr("is not held"));
  hold(1s);
  EXPECT_EQ(use(), "used");
}

TEST_F(Held, AGapBeginsAnew) {
  hold(2s);
  now_ += 201ms;
  EXPECT_THAT(use(), HasSubstr("is not held"));
  hold(950ms);
  EXPECT_THAT(use(), HasSubstr("held for 0.9"));
}

TEST_F(Held, SlowRenewalsAreNone) {
  hold(10s, 300ms);
  EXPECT_THAT(use(), HasSubstr("held for 0.0 s"));
}

TEST_F(Held, RenewalsThatComeAtOnceCountForAMoment) {
  key_.renew(now_);
  now_ += 5s;
  for (int i = 0; i < 100; ++i) key_.renew(now_);
  EXPECT_THAT(use(), HasSubstr("held for 0.0 s"));
}

TEST_F(Held, ItIsHeldStillWhenItIsUsed) {
  hold(3s);
  key_.release();
  EXPECT_THAT(use(), HasSubstr("is not held"));
}

}  // namespace
}  // namespace armature::studio::internal
