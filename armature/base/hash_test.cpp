// SPDX-License-Identifier: Apache-2.0
#include "armature/base/hash.hpp"

#include <gtest/gtest.h>

namespace armature::base {
namespace {

TEST(Fnv1a, GivesThePublishedValues) {
  EXPECT_EQ(fnv1a(""), 0x811c9dc5u);
  EXPECT_EQ(fnv1a("a"), 0xe40c292cu);
  EXPECT_EQ(fnv1a("foobar"), 0xbf9cf968u);
}

TEST(Fnv1a, GivesTheOperationNumbersOfTheWireProtocol) {
  EXPECT_EQ(fnv1a("void setVelocity(float,float)"), 0x66e299dfu);
  EXPECT_EQ(fnv1a("void start()"), 0xdcab56acu);
  EXPECT_EQ(fnv1a("event ObjectPosition{int,int}"), 0x714c2b59u);
}

TEST(Fnv1a, ContinuesFromAnEarlierHash) { EXPECT_EQ(fnv1a("bar", fnv1a("foo")), fnv1a("foobar")); }

TEST(Fnv1a, TreatsBytesAsUnsigned) {
  EXPECT_EQ(fnv1a("\xff"), (0x811c9dc5u ^ 0xffu) * 0x01000193u);
}

}  // namespace
}  // namespace armature::base
