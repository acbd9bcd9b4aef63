// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/protocol/puck_properties.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "robots/wam/internal/puck_property_rows.hpp"

namespace armature::wam {
namespace {

using internal::Row;

constexpr auto kNames = std::to_array<const char*>(
    {"VERS",   "ROLE",   "SN",    "ID",     "ERROR",   "STAT",    "ADDR",    "VALUE",  "MODE",
     "TEMP",   "PTEMP",  "OTEMP", "BAUD",   "LOCK",    "DIG0",    "DIG1",    "FET0",   "FET1",
     "ANA0",   "ANA1",   "THERM", "VBUS",   "IMOTOR",  "VLOGIC",  "ILOGIC",  "SG",     "GRPA",
     "GRPB",   "GRPC",   "CMD",   "SAVE",   "LOAD",    "DEF",     "FIND",    "X0",     "X1",
     "X2",     "X3",     "X4",    "X5",     "X6",      "X7",      "T",       "MT",     "V",
     "MV",     "MCV",    "MOV",   "P",      "DP",      "E",       "OT",      "CT",     "M",
     "DS",     "MOFST",  "IOFST", "UPSECS", "OD",      "MDS",     "MECH",    "CTS",    "PIDX",
     "HSG",    "LSG",    "IVEL",  "IOFF",   "MPE",     "HOLD",    "TSTOP",   "KP",     "KD",
     "KI",     "ACCEL",  "TENST", "TENSO",  "JIDX",    "IPNM",    "HALLS",   "HALLH",  "POLES",
     "IKP",    "IKI",    "IKCOR", "EN",     "JP",      "JOFST",   "TIE",     "ECMAX",  "ECMIN",
     "LFLAGS", "LCTC",   "LCVC",  "TACT",   "TACTID",  "IHIT",    "D",       "MD",     "VCMD",
     "ZERO",   "SAMPLE", "UNITS", "RATIO",  "LOG",     "DUMP",    "LOG1",    "LOG2",   "LOG3",
     "LOG4",   "GAIN1",  "GAIN2", "GAIN3",  "OFFSET1", "OFFSET2", "OFFSET3", "PEN",    "SAFE",
     "VL1",    "VL2",    "TL1",   "TL2",    "VOLTL1",  "VOLTL2",  "VOLTH1",  "VOLTH2", "MAXPWR",
     "PWR",    "IFAULT", "PLOG",  "PDATA",  "A",       "VNOM",    "ITOR",    "ISQ",    "TETAE",
     "LCV",    "LFV",    "LFS",   "LFAP",   "LFDP",    "LFT",     "VALUE32", "SG1",    "SG2",
     "SG3",    "SG4",    "SG5",   "SG6",    "FX",      "FY",      "FZ",      "TX",     "TY",
     "TZ",     "FT",     "AX",    "AY",     "AZ",      "GM",      "OV",      "LED",    "T1",
     "T2",     "T3"});
static_assert(kNames.size() == kProperties);

constexpr auto kSecondNames =
    std::to_array<std::pair<std::string_view, Property>>({{"AP", Property::kP},
                                                          {"TORQ", Property::kT},
                                                          {"B", Property::kFet0},
                                                          {"TENSION", Property::kFet1}});

std::span<const Row> rows_of(PuckKind kind) {
  switch (kind) {
    case PuckKind::kMonitor:
      return internal::kMonitorRows;
    case PuckKind::kSafety:
      return internal::kSafetyRows;
    case PuckKind::kMotor:
      return internal::kMotorRows;
    case PuckKind::kForceTorque:
      return internal::kForceTorqueRows;
  }
  return {};
}

/// Those whose values have 32 bits where the numbers leave room for them.
bool is_wide_by_nature(Property property) {
  switch (property) {
    case Property::kP:
    case Property::kDp:
    case Property::kE:
    case Property::kOt:
    case Property::kCt:
    case Property::kM:
    case Property::kMech:
    case Property::kCts:
    case Property::kIoff:
    case Property::kHallh:
    case Property::kJp:
    case Property::kJofst:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::optional<int> number_of(PuckKind kind, int version, Property property) {
  std::optional<int> number;
  for (const Row& row : rows_of(kind)) {  // in the order of their versions
    if (row.property != property || row.from > version) continue;
    number = row.number == internal::kNone ? std::nullopt : std::optional<int>(row.number);
  }
  return number;
}

std::optional<Property> property_of(PuckKind kind, int version, int number) {
  for (std::size_t i = 0; i < kProperties; ++i) {
    const auto property = static_cast<Property>(i);
    if (number_of(kind, version, property) == number) return property;
  }
  return std::nullopt;
}

bool is_wide(PuckKind kind, int version, Property property) {
  if (kind == PuckKind::kSafety && property == Property::kPen) return true;  // its bits need it
  const std::optional<int> number = number_of(kind, version, property);
  return number && is_wide_by_nature(property) && !property_of(kind, version, *number + 1);
}

const char* to_text(Property property) { return kNames[static_cast<std::size_t>(property)]; }

const char* to_text(PuckKind kind) {
  switch (kind) {
    case PuckKind::kMonitor:
      return "monitor";
    case PuckKind::kSafety:
      return "safety board";
    case PuckKind::kMotor:
      return "motor puck";
    case PuckKind::kForceTorque:
      return "force/torque sensor";
  }
  return "?";
}

std::optional<Property> parse_property(std::string_view name) {
  for (const auto& [second, property] : kSecondNames) {
    if (name == second) return property;
  }
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Property>(found - kNames.begin());
}

}  // namespace armature::wam
