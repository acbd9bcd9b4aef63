// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/internal/harmless.hpp"

#include <gtest/gtest.h>

namespace armature::remote::internal {
namespace {

TEST(HarmlessText, MovesNoCursor) {
  EXPECT_EQ(harmless("a\x1b[2J\x07\x7f"
                     "b\n\tc"),
            "a?[2J??b\n\tc");
  EXPECT_EQ(harmless("gr\xc3\xb6\xc3\x9f"
                     "er 5 \xc2\xb5m \xc2\x9b"),
            "gr\xc3\xb6\xc3\x9f"
            "er 5 \xc2\xb5m \xc2?");
}

}  // namespace
}  // namespace armature::remote::internal
