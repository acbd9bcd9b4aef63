// SPDX-License-Identifier: Apache-2.0
#include "armature/control/polynomial.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace armature::control {
namespace {

TEST(Polynomial, IsMultipliedAndAdded) {
  const Polynomial product = Polynomial{1.0, 2.0} * Polynomial{3.0, 0.0, 1.0};
  const Polynomial sum = product * 2.0 + Polynomial{1.0};
  for (const auto& [power, expected] :
       {std::pair{0U, 7.0}, {1U, 12.0}, {2U, 2.0}, {3U, 4.0}, {4U, 0.0}}) {
    EXPECT_DOUBLE_EQ(sum[power], expected) << power;
  }
}

TEST(Polynomial, FindsItsRoots) {
  Polynomial::Roots roots;
  // (z - 0.5) (z^2 + 1)
  const Polynomial cubic = Polynomial{-0.5, 1.0} * Polynomial{1.0, 0.0, 1.0};
  ASSERT_EQ(cubic.find_roots(roots), 3U);
  std::sort(roots.begin(), roots.begin() + 3,
            [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
  EXPECT_NEAR(std::abs(roots[0] - std::complex(0.0, -1.0)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(roots[1] - std::complex(0.5, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(roots[2] - std::complex(0.0, 1.0)), 0.0, 1e-12);
}

TEST(Polynomial, OfLeadingZerosHasTheRootsOfTheRest) {
  Polynomial::Roots roots;
  EXPECT_EQ((Polynomial{-1.0, 2.0, 0.0, 0.0}.find_roots(roots)), 1U);
  EXPECT_DOUBLE_EQ(roots[0].real(), 0.5);
  EXPECT_EQ(Polynomial{3.0}.find_roots(roots), 0U);
}

}  // namespace
}  // namespace armature::control
