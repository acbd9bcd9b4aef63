// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/safety_text.hpp"

#include <string>

#include <gtest/gtest.h>

namespace armature::wam {
namespace {

TEST(SafetyText, SaysFirstWhatSaves) {
  for (const WamFault fault : {WamFault::kNoBus, WamFault::kPuckSilent}) {
    const std::string calm(fault_reason(fault, kEveryNode).view());
    const std::string urgent(fault_reason(fault, kEveryNode, true).view());
    EXPECT_TRUE(urgent.starts_with("press E-stop, motors may go on as they were told last; "));
    EXPECT_TRUE(urgent.ends_with(calm)) << urgent;
  }
}

TEST(SafetyText, NoReasonIsCut) {
  for (int i = 0; i <= static_cast<int>(WamFault::kOther); ++i) {
    const auto fault = static_cast<WamFault>(i);
    const std::string reason(fault_reason(fault, 7, true).view());
    const bool whole =
        fault == WamFault::kNone || reason.ends_with("start") || reason.ends_with("arm");
    EXPECT_TRUE(whole) << reason;
    EXPECT_LT(reason.size(), 511u);
  }
}

}  // namespace
}  // namespace armature::wam
