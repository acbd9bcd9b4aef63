// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/object_dictionary.hpp"

#include <utility>

#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {
namespace {

AbortCode check_number(const ObjectDictionary::Entry& entry, std::uint64_t raw) {
  const unsigned bits = bits_of(entry.info.type);
  const bool negative = is_signed(entry.info.type) && sign_extended(raw, bits) < 0;
  const auto value =
      is_signed(entry.info.type) ? sign_extended(raw, bits) : static_cast<std::int64_t>(raw);
  if (is_real(entry.info.type)) return AbortCode::kNone;
  if (entry.info.type == DataType::kBoolean && raw > 1) return AbortCode::kInvalidValue;
  const bool huge = !negative && value < 0;  // an unsigned number beyond the signed ones
  if (entry.info.low && !huge && value < *entry.info.low) return AbortCode::kValueTooLow;
  if (entry.info.high && (huge || value > *entry.info.high)) return AbortCode::kValueTooHigh;
  return AbortCode::kNone;
}

}  // namespace

void ObjectDictionary::add(ObjectInfo info, std::uint64_t raw) {
  const Address address = info.address;
  entries_[address] = Entry{.info = std::move(info), .raw = raw, .bytes = {}, .check = {}};
}

void ObjectDictionary::add_bytes(ObjectInfo info, std::span<const std::uint8_t> bytes) {
  const Address address = info.address;
  entries_[address] =
      Entry{.info = std::move(info), .raw = 0, .bytes = {bytes.begin(), bytes.end()}, .check = {}};
}

void ObjectDictionary::add_count(std::uint16_t index, std::string name, std::uint8_t count,
                                 Access access) {
  add({.address = {index, 0},
       .name = std::move(name),
       .type = DataType::kUnsigned8,
       .access = access},
      count);
}

ObjectDictionary::Entry* ObjectDictionary::find(Address address) noexcept {
  const auto found = entries_.find(address);
  return found == entries_.end() ? nullptr : &found->second;
}

const ObjectDictionary::Entry* ObjectDictionary::find(Address address) const noexcept {
  const auto found = entries_.find(address);
  return found == entries_.end() ? nullptr : &found->second;
}

std::int64_t ObjectDictionary::number(Address address) const noexcept {
  const Entry* const entry = find(address);
  if (entry == nullptr) return 0;
  if (!is_signed(entry->info.type)) return static_cast<std::int64_t>(entry->raw);
  return sign_extended(entry->raw, bits_of(entry->info.type));
}

void ObjectDictionary::set_number(Address address, std::int64_t value) noexcept {
  Entry* const entry = find(address);
  if (entry == nullptr) return;
  entry->raw = static_cast<std::uint64_t>(value) & low_bits(bits_of(entry->info.type));
}

AbortCode ObjectDictionary::missing(Address address) const noexcept {
  const auto any = entries_.lower_bound({address.index, 0});
  const bool has_index = any != entries_.end() && any->first.index == address.index;
  return has_index ? AbortCode::kNoSubindex : AbortCode::kNoObject;
}

AbortCode ObjectDictionary::read(Address address, std::vector<std::uint8_t>& bytes) const {
  const Entry* const entry = find(address);
  if (entry == nullptr) return missing(address);
  if (!may_read(entry->info.access)) return AbortCode::kWriteOnly;
  const unsigned size = bytes_of_bits(bits_of(entry->info.type));
  if (size == 0) {
    bytes = entry->bytes;
    return AbortCode::kNone;
  }
  bytes.resize(size);
  store(bytes, entry->raw);
  return AbortCode::kNone;
}

AbortCode ObjectDictionary::may_be_written(Address address) const {
  const Entry* const entry = find(address);
  if (entry == nullptr) return missing(address);
  return may_write(entry->info.access) ? AbortCode::kNone : AbortCode::kReadOnly;
}

AbortCode ObjectDictionary::write(Address address, std::span<const std::uint8_t> bytes) {
  if (const AbortCode refused = may_be_written(address); refused != AbortCode::kNone) {
    return refused;
  }
  Entry& entry = *find(address);
  const unsigned size = bytes_of_bits(bits_of(entry.info.type));
  if (size == 0) {
    entry.bytes.assign(bytes.begin(), bytes.end());
    return AbortCode::kNone;
  }
  if (bytes.size() != size) return bytes.size() > size ? AbortCode::kTooLong : AbortCode::kTooShort;
  const std::uint64_t raw = load(bytes);
  AbortCode code = check_number(entry, raw);
  if (code == AbortCode::kNone && entry.check) code = entry.check(raw);
  if (code == AbortCode::kNone) entry.raw = raw;
  return code;
}

}  // namespace armature::canopen
