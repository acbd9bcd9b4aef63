// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace armature::wam {

// The properties of pucks and of the safety board, and their numbers on the bus, which depend on
// what the device is and on its firmware: see PROTOCOL.md. Everything here is nonblocking and
// allocates nothing.

/// Names as the vendor has them.
enum class Property : std::uint8_t {
  kVers,
  kRole,
  kSn,
  kId,
  kError,
  kStat,
  kAddr,
  kValue,
  kMode,
  kTemp,
  kPtemp,
  kOtemp,
  kBaud,
  kLock,
  kDig0,
  kDig1,
  kFet0,
  kFet1,
  kAna0,
  kAna1,
  kTherm,
  kVbus,
  kImotor,
  kVlogic,
  kIlogic,
  kSg,
  kGrpa,
  kGrpb,
  kGrpc,
  kCmd,
  kSave,
  kLoad,
  kDef,
  kFind,
  kX0,
  kX1,
  kX2,
  kX3,
  kX4,
  kX5,
  kX6,
  kX7,
  kT,
  kMt,
  kV,
  kMv,
  kMcv,
  kMov,
  kP,
  kDp,
  kE,
  kOt,
  kCt,
  kM,
  kDs,
  kMofst,
  kIofst,
  kUpsecs,
  kOd,
  kMds,
  kMech,
  kCts,
  kPidx,
  kHsg,
  kLsg,
  kIvel,
  kIoff,
  kMpe,
  kHold,
  kTstop,
  kKp,
  kKd,
  kKi,
  kAccel,
  kTenst,
  kTenso,
  kJidx,
  kIpnm,
  kHalls,
  kHallh,
  kPoles,
  kIkp,
  kIki,
  kIkcor,
  kEn,
  kJp,
  kJofst,
  kTie,
  kEcmax,
  kEcmin,
  kLflags,
  kLctc,
  kLcvc,
  kTact,
  kTactid,
  kIhit,
  kD,
  kMd,
  kVcmd,
  kZero,
  kSample,
  kUnits,
  kRatio,
  kLog,
  kDump,
  kLog1,
  kLog2,
  kLog3,
  kLog4,
  kGain1,
  kGain2,
  kGain3,
  kOffset1,
  kOffset2,
  kOffset3,
  kPen,
  kSafe,
  kVl1,
  kVl2,
  kTl1,
  kTl2,
  kVoltl1,
  kVoltl2,
  kVolth1,
  kVolth2,
  kMaxpwr,
  kPwr,
  kIfault,
  kPlog,
  kPdata,
  kA,
  kVnom,
  kItor,
  kIsq,
  kTetae,
  kLcv,
  kLfv,
  kLfs,
  kLfap,
  kLfdp,
  kLft,
  kValue32,
  kSg1,
  kSg2,
  kSg3,
  kSg4,
  kSg5,
  kSg6,
  kFx,
  kFy,
  kFz,
  kTx,
  kTy,
  kTz,
  kFt,
  kAx,
  kAy,
  kAz,
  kGm,
  kOv,
  kLed,
  kT1,
  kT2,
  kT3
};
constexpr std::size_t kProperties = static_cast<std::size_t>(Property::kT3) + 1;

/// Which table of numbers holds.
enum class PuckKind : std::uint8_t {
  kMonitor,      ///< any puck whose main firmware does not run
  kSafety,       ///< the safety board
  kMotor,        ///< pucks of the arm and of the hand
  kForceTorque,  ///< the sensor at the wrist
};

/// The number that a device with firmware `version` knows the property by.
/// @return 0 to 127; none if it has no such property
/// @rt nonblocking, no allocation, O(breakpoints of the kind)
std::optional<int> number_of(PuckKind kind, int version, Property property);

/// The property that has this number there.
/// @rt nonblocking, no allocation, O(properties x breakpoints of the kind)
std::optional<Property> property_of(PuckKind kind, int version, int number);

/// Whether its value has 32 bits there; others have 16.
/// @rt nonblocking, no allocation
bool is_wide(PuckKind kind, int version, Property property);

const char* to_text(Property property);
const char* to_text(PuckKind kind);
/// By the vendor's name, or by one of its second names: AP for P, TORQ for T, B for FET0, TENSION
/// for FET1.
std::optional<Property> parse_property(std::string_view name);

}  // namespace armature::wam
