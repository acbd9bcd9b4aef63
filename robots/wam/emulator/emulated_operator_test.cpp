// SPDX-License-Identifier: Apache-2.0
// The operator of an emulated arm, and the moment that its board is given to say why it idled.
#include "robots/wam/emulator/emulated_operator.hpp"

#include <chrono>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "robots/wam/driver/cause_search.hpp"
#include "robots/wam/test_arms.hpp"

namespace armature::wam {
namespace {

using namespace std::chrono_literals;

class EmulatedOperatorTest : public ::testing::Test {
 protected:
  EmulatedOperatorTest() {
    EmulatedLink::Config config;
    config.arm.urdf_file = description_of(wam4());
    config.arm.start = {0.3, -1.5, 0.2, 2.5};
    auto made = EmulatedLink::make(wam4(), config);
    EXPECT_TRUE(made.ok()) << made.error();
    link_ = std::move(made).value();
    base::Diagnostics diagnostics;
    EXPECT_TRUE(link_->open({}, diagnostics)) << diagnostics.to_text();
    operator_ = std::make_unique<EmulatedOperator>(*link_);
  }
  BoardMode mode() { return link_->emulator().board().mode(); }

  std::unique_ptr<EmulatedLink> link_;
  std::unique_ptr<EmulatedOperator> operator_;
};

TEST_F(EmulatedOperatorTest, CarriesTheArmHomeAndGivesItsPucksPower) {
  ASSERT_EQ(mode(), BoardMode::kEstop);
  ASSERT_GT(link_->from_home(), 0.1);
  operator_->bring_to_idle();
  EXPECT_LT(link_->from_home(), 1e-5);
  EXPECT_EQ(mode(), BoardMode::kIdle);
}

TEST_F(EmulatedOperatorTest, PressesAKeyOnceItWasAskedForATenthOfASecond) {
  const base::Time begin = link_->now();
  operator_->press_reset();
  operator_->help_to_activate(true, begin);
  operator_->help_to_activate(true, begin + 99ms);
  EXPECT_EQ(mode(), BoardMode::kEstop);
  operator_->help_to_activate(true, begin + 100ms);
  EXPECT_EQ(mode(), BoardMode::kIdle);
}

TEST_F(EmulatedOperatorTest, BeginsAnewWhenItIsAskedAgain) {
  const base::Time begin = link_->now();
  operator_->press_reset();
  operator_->help_to_activate(true, begin);
  operator_->rest();
  operator_->help_to_activate(true, begin + 100ms);
  EXPECT_EQ(mode(), BoardMode::kEstop);
}

TEST(CauseSearch, WithoutAFaultOfTheBoardItWasTheOperator) {
  CauseSearch search;
  EXPECT_FALSE(search.under_way());
  const base::Time begin(1h);
  search.begin(begin);
  EXPECT_EQ(search.look_at_idle(begin), CauseSearch::Found::kNothingYet);
  EXPECT_EQ(search.look_at_idle(begin + 149ms), CauseSearch::Found::kNothingYet);
  EXPECT_TRUE(search.under_way());
  EXPECT_EQ(search.look_at_idle(begin + 150ms), CauseSearch::Found::kOperator);
  EXPECT_FALSE(search.under_way());
}

}  // namespace
}  // namespace armature::wam
