// SPDX-License-Identifier: Apache-2.0
// The chassis on the wire: what table 4 of paper 4 declares has the same numbers here, so that any
// program of RIDE commands it.
#include <cstdint>
#include <string_view>

#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/remote/interface_numbers.hpp"
#include "robots/rover/chassis_drive.hpp"

namespace armature::rover {
namespace {

using Kind = remote::NumberedMember::Kind;

/// docs/ride.md
std::uint32_t number_of(std::string_view canonical) {
  std::uint32_t number = 0x811c9dc5U;
  for (const char each : canonical) {
    number = (number ^ static_cast<unsigned char>(each)) * 0x01000193U;
  }
  return number;
}

TEST(Table4, TheChassisHasItsCommandAndItsEventByTheirNumbers) {
  ChassisDrive drive("Drive");
  const remote::InterfaceNumbers numbers("Chassis", component::interface_of(drive));
  ASSERT_EQ(number_of("void setVelocity(float,float)"), 0x66e299dfU) << "as docs/ride.md has it";
  const auto* const command = numbers.find(ride::Number(0x66e299dfU));
  ASSERT_NE(command, nullptr);
  EXPECT_EQ(command->kind, Kind::kCommand);
  const auto* const stopped = numbers.find(ride::Number(number_of("event Stopped{String}")));
  ASSERT_NE(stopped, nullptr);
  EXPECT_EQ(stopped->kind, Kind::kEvent);
}

}  // namespace
}  // namespace armature::rover
