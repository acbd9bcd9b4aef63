// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/object.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

namespace armature::canopen {
namespace {

enum class NumberKind : std::uint8_t { kUnsigned, kSigned, kReal, kOther };

struct DataTypeRow {
  DataType type;
  unsigned bits;
  NumberKind kind;
  const char* name;
};

constexpr std::array kDataTypes = {
    DataTypeRow{DataType::kBoolean, 1, NumberKind::kUnsigned, "BOOLEAN"},
    DataTypeRow{DataType::kInteger8, 8, NumberKind::kSigned, "INTEGER8"},
    DataTypeRow{DataType::kInteger16, 16, NumberKind::kSigned, "INTEGER16"},
    DataTypeRow{DataType::kInteger24, 24, NumberKind::kSigned, "INTEGER24"},
    DataTypeRow{DataType::kInteger32, 32, NumberKind::kSigned, "INTEGER32"},
    DataTypeRow{DataType::kInteger40, 40, NumberKind::kSigned, "INTEGER40"},
    DataTypeRow{DataType::kInteger48, 48, NumberKind::kSigned, "INTEGER48"},
    DataTypeRow{DataType::kInteger56, 56, NumberKind::kSigned, "INTEGER56"},
    DataTypeRow{DataType::kInteger64, 64, NumberKind::kSigned, "INTEGER64"},
    DataTypeRow{DataType::kUnsigned8, 8, NumberKind::kUnsigned, "UNSIGNED8"},
    DataTypeRow{DataType::kUnsigned16, 16, NumberKind::kUnsigned, "UNSIGNED16"},
    DataTypeRow{DataType::kUnsigned24, 24, NumberKind::kUnsigned, "UNSIGNED24"},
    DataTypeRow{DataType::kUnsigned32, 32, NumberKind::kUnsigned, "UNSIGNED32"},
    DataTypeRow{DataType::kUnsigned40, 40, NumberKind::kUnsigned, "UNSIGNED40"},
    DataTypeRow{DataType::kUnsigned48, 48, NumberKind::kUnsigned, "UNSIGNED48"},
    DataTypeRow{DataType::kUnsigned56, 56, NumberKind::kUnsigned, "UNSIGNED56"},
    DataTypeRow{DataType::kUnsigned64, 64, NumberKind::kUnsigned, "UNSIGNED64"},
    DataTypeRow{DataType::kReal32, 32, NumberKind::kReal, "REAL32"},
    DataTypeRow{DataType::kReal64, 64, NumberKind::kReal, "REAL64"},
    DataTypeRow{DataType::kTimeOfDay, 48, NumberKind::kUnsigned, "TIME_OF_DAY"},
    DataTypeRow{DataType::kTimeDifference, 48, NumberKind::kUnsigned, "TIME_DIFFERENCE"},
    DataTypeRow{DataType::kVisibleString, 0, NumberKind::kOther, "VISIBLE_STRING"},
    DataTypeRow{DataType::kOctetString, 0, NumberKind::kOther, "OCTET_STRING"},
    DataTypeRow{DataType::kUnicodeString, 0, NumberKind::kOther, "UNICODE_STRING"},
    DataTypeRow{DataType::kDomain, 0, NumberKind::kOther, "DOMAIN"},
};

const DataTypeRow* find_data_type(std::uint32_t number) noexcept {
  const auto* const row = std::ranges::find_if(kDataTypes, [number](const DataTypeRow& each) {
    return static_cast<std::uint32_t>(each.type) == number;
  });
  return row == kDataTypes.end() ? nullptr : row;
}

const DataTypeRow* row_of(DataType type) noexcept {
  return find_data_type(static_cast<std::uint32_t>(type));
}

}  // namespace

std::optional<Address> parse_address(std::string_view text) noexcept {
  if (text.starts_with("0x")) text.remove_prefix(2);
  const std::size_t colon = std::min(text.find(':'), text.size());
  Address address;
  const auto parse = [](std::string_view digits, auto& number) {
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  if (!parse(text.substr(0, colon), address.index)) return std::nullopt;
  if (colon == text.size()) return address;
  if (!parse(text.substr(colon + 1), address.subindex)) return std::nullopt;
  return address;
}

std::string to_text(Address address) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%04X:%02X", address.index, address.subindex);
  return text.data();
}

bool is_data_type(std::uint32_t number) noexcept { return find_data_type(number) != nullptr; }

unsigned bits_of(DataType type) noexcept {
  const DataTypeRow* const row = row_of(type);
  return row == nullptr ? 0 : row->bits;
}

bool is_signed(DataType type) noexcept {
  const DataTypeRow* const row = row_of(type);
  return row != nullptr && row->kind == NumberKind::kSigned;
}

bool is_real(DataType type) noexcept {
  const DataTypeRow* const row = row_of(type);
  return row != nullptr && row->kind == NumberKind::kReal;
}

const char* to_text(DataType type) noexcept {
  const DataTypeRow* const row = row_of(type);
  return row == nullptr ? "unknown type" : row->name;
}

}  // namespace armature::canopen
