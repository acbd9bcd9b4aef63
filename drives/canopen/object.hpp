// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace armature::canopen {

/// Where an object is in a device's dictionary.
struct Address {
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;

  friend auto operator<=>(const Address&, const Address&) = default;
};

/// As people write it: `0x6040:00`.
std::string to_text(Address address);
/// The address that a text is, both numbers hexadecimal: `0x6040:00`, `0x6040`, `2000:1a`.
std::optional<Address> parse_address(std::string_view text) noexcept;

/// Types of objects, with the numbers that EDS files give them (CiA 301, 7.4.7).
enum class DataType : std::uint16_t {
  kBoolean = 0x01,
  kInteger8 = 0x02,
  kInteger16 = 0x03,
  kInteger32 = 0x04,
  kUnsigned8 = 0x05,
  kUnsigned16 = 0x06,
  kUnsigned32 = 0x07,
  kReal32 = 0x08,
  kVisibleString = 0x09,
  kOctetString = 0x0a,
  kUnicodeString = 0x0b,
  kTimeOfDay = 0x0c,
  kTimeDifference = 0x0d,
  kDomain = 0x0f,
  kInteger24 = 0x10,
  kReal64 = 0x11,
  kInteger40 = 0x12,
  kInteger48 = 0x13,
  kInteger56 = 0x14,
  kInteger64 = 0x15,
  kUnsigned24 = 0x16,
  kUnsigned40 = 0x18,
  kUnsigned48 = 0x19,
  kUnsigned56 = 0x1a,
  kUnsigned64 = 0x1b,
};

/// Whether it is one of the enumerators.
bool is_data_type(std::uint32_t number) noexcept;
/// How many bits a PDO takes for it; 0 for texts and domains, whose length varies. A boolean has 1.
unsigned bits_of(DataType type) noexcept;
/// Whole bytes of a number in an SDO; 0 where the length varies.
constexpr unsigned bytes_of_bits(unsigned bits) noexcept { return (bits + 7) / 8; }
/// Whether the number is in two's complement.
bool is_signed(DataType type) noexcept;
bool is_real(DataType type) noexcept;
/// `INTEGER32`.
const char* to_text(DataType type) noexcept;

/// What others on the bus may do with an object.
enum class Access : std::uint8_t {
  kConstant,
  kReadOnly,
  kWriteOnly,
  kReadWrite,
};
constexpr bool may_read(Access access) { return access != Access::kWriteOnly; }
constexpr bool may_write(Access access) {
  return access == Access::kWriteOnly || access == Access::kReadWrite;
}

}  // namespace armature::canopen
