// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drives/canopen/object.hpp"

namespace armature::cia402 {

/// Where CiA 402 has what this library uses.
namespace object {
using canopen::Address;
/// What a drive does that loses its host (CiA 402-2): 0 nothing, 1 fault, 2 voltage off, 3 quick
/// stop.
constexpr Address kAbortConnection{0x6007, 0};
constexpr Address kErrorCode{0x603f, 0};
constexpr Address kControlWord{0x6040, 0};
constexpr Address kStatusWord{0x6041, 0};
constexpr Address kQuickStopOption{0x605a, 0};
constexpr Address kMode{0x6060, 0};
constexpr Address kModeDisplay{0x6061, 0};
constexpr Address kPositionDemand{0x6062, 0};
constexpr Address kPosition{0x6064, 0};
constexpr Address kFollowingErrorWindow{0x6065, 0};
constexpr Address kVelocity{0x606c, 0};
constexpr Address kTargetTorque{0x6071, 0};
constexpr Address kMostTorque{0x6072, 0};
constexpr Address kRatedCurrent{0x6075, 0};
constexpr Address kRatedTorque{0x6076, 0};
constexpr Address kTorque{0x6077, 0};
constexpr Address kCurrent{0x6078, 0};
constexpr Address kTargetPosition{0x607a, 0};
constexpr Address kHomeOffset{0x607c, 0};
constexpr Address kPolarity{0x607e, 0};
constexpr Address kProfileVelocity{0x6081, 0};
constexpr Address kProfileAcceleration{0x6083, 0};
constexpr Address kProfileDeceleration{0x6084, 0};
constexpr Address kQuickStopDeceleration{0x6085, 0};
constexpr Address kEncoderIncrements{0x608f, 1};
constexpr Address kEncoderRevolutions{0x608f, 2};
constexpr Address kGearMotor{0x6091, 1};
constexpr Address kGearShaft{0x6091, 2};
constexpr Address kFeed{0x6092, 1};
constexpr Address kFeedShaft{0x6092, 2};
constexpr Address kHomingMethod{0x6098, 0};
constexpr Address kHomingSpeed{0x6099, 1};
constexpr Address kHomingSlowSpeed{0x6099, 2};
constexpr Address kHomingAcceleration{0x609a, 0};
constexpr Address kInterpolationTime{0x60c2, 1};
constexpr Address kInterpolationExponent{0x60c2, 2};
constexpr Address kTargetVelocity{0x60ff, 0};
constexpr Address kSupportedModes{0x6502, 0};
/// Of the emulated drive alone [0.1 °C]; CiA 402 has no temperature.
constexpr Address kEmulatedTemperature{0x2001, 0};
}  // namespace object

}  // namespace armature::cia402
