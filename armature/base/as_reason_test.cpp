// SPDX-License-Identifier: Apache-2.0
#include "armature/base/as_reason.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(AsReason, HasTheErrorsInOneLineWithoutTheirSeverity) {
  Diagnostics diagnostics;
  diagnostics.error({}, "the bus is not there", "plug it in");
  diagnostics.warning({}, "it is cold");
  diagnostics.error({}, "nobody answers");
  EXPECT_EQ(as_reason(diagnostics), "the bus is not there (plug it in); nobody answers");
  EXPECT_EQ(as_reason({}), "");
}

}  // namespace
}  // namespace armature::base
