// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/homing.hpp"

#include <algorithm>
#include <array>

namespace armature::cia402 {
namespace {

using enum HomingMark;
using enum HomingDirection;

constexpr std::array kMethods = {
    HomingMethod{1, kNegativeLimit, kNegative, true},
    HomingMethod{2, kPositiveLimit, kPositive, true},
    HomingMethod{3, kHomeSwitch, kPositive, true},
    HomingMethod{4, kHomeSwitch, kPositive, true},
    HomingMethod{5, kHomeSwitch, kNegative, true},
    HomingMethod{6, kHomeSwitch, kNegative, true},
    HomingMethod{7, kHomeSwitch, kPositive, true},
    HomingMethod{8, kHomeSwitch, kPositive, true},
    HomingMethod{9, kHomeSwitch, kPositive, true},
    HomingMethod{10, kHomeSwitch, kPositive, true},
    HomingMethod{11, kHomeSwitch, kNegative, true},
    HomingMethod{12, kHomeSwitch, kNegative, true},
    HomingMethod{13, kHomeSwitch, kNegative, true},
    HomingMethod{14, kHomeSwitch, kNegative, true},
    HomingMethod{17, kNegativeLimit, kNegative, false},
    HomingMethod{18, kPositiveLimit, kPositive, false},
    HomingMethod{19, kHomeSwitch, kPositive, false},
    HomingMethod{20, kHomeSwitch, kPositive, false},
    HomingMethod{21, kHomeSwitch, kNegative, false},
    HomingMethod{22, kHomeSwitch, kNegative, false},
    HomingMethod{23, kHomeSwitch, kPositive, false},
    HomingMethod{24, kHomeSwitch, kPositive, false},
    HomingMethod{25, kHomeSwitch, kPositive, false},
    HomingMethod{26, kHomeSwitch, kPositive, false},
    HomingMethod{27, kHomeSwitch, kNegative, false},
    HomingMethod{28, kHomeSwitch, kNegative, false},
    HomingMethod{29, kHomeSwitch, kNegative, false},
    HomingMethod{30, kHomeSwitch, kNegative, false},
    HomingMethod{33, HomingMark::kNothing, kNegative, true},
    HomingMethod{34, HomingMark::kNothing, kPositive, true},
    HomingMethod{35, kHere, HomingDirection::kNone, false},
    HomingMethod{37, kHere, HomingDirection::kNone, false},
};

}  // namespace

std::span<const HomingMethod> homing_methods() noexcept { return kMethods; }

std::optional<HomingMethod> find_homing_method(std::int8_t number) noexcept {
  const auto* const found =
      std::ranges::find(kMethods, number, [](const HomingMethod& method) { return method.number; });
  if (found == kMethods.end()) return std::nullopt;
  return *found;
}

}  // namespace armature::cia402
