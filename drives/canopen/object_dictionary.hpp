// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drives/canopen/abort_code.hpp"
#include "drives/canopen/object.hpp"

namespace armature::canopen {

/// What is known of an object before it has a value.
struct ObjectInfo {
  Address address;
  std::string name;
  DataType type = DataType::kUnsigned32;
  Access access = Access::kReadWrite;
  bool mappable = false;                  ///< to a PDO
  std::optional<std::int64_t> low = {};   ///< least value that others may write
  std::optional<std::int64_t> high = {};  ///< greatest value that others may write
};

/// The objects of a device: what its SDO server serves and its PDOs carry.
class ObjectDictionary {
 public:
  /// Asked before a value is taken that came from the bus; anything but `kNone` refuses it.
  using Check = std::function<AbortCode(std::uint64_t raw)>;

  struct Entry {
    ObjectInfo info;
    std::uint64_t raw = 0;            ///< of a number, its bits
    std::vector<std::uint8_t> bytes;  ///< of anything else
    Check check;
  };

  /// Adds a number; one that is there already is replaced.
  void add(ObjectInfo info, std::uint64_t raw = 0);
  /// Adds a text or a domain.
  void add_bytes(ObjectInfo info, std::span<const std::uint8_t> bytes);
  /// Adds subindex 0 of a record or an array, which is the highest subindex.
  void add_count(std::uint16_t index, std::string name, std::uint8_t count,
                 Access access = Access::kConstant);
  /// @param address  of a number that is there
  void set_check(Address address, Check check) { entries_.at(address).check = std::move(check); }

  /// Stays valid until one is added at the same address; nullptr if there is none.
  /// @rt nonblocking, no allocation, O(log objects)
  Entry* find(Address address) noexcept;
  /// @rt nonblocking, no allocation, O(log objects)
  const Entry* find(Address address) const noexcept;
  const std::map<Address, Entry>& entries() const { return entries_; }

  /// The number's value with its sign; 0 if it is not there.
  /// @rt nonblocking, no allocation, O(log objects)
  std::int64_t number(Address address) const noexcept;
  /// The device's own change of a number, whatever others may do with it; none if it is not there.
  /// @rt nonblocking, no allocation, O(log objects)
  void set_number(Address address, std::int64_t value) noexcept;

  /// What others read.
  /// @param bytes  the value, if the answer is `kNone`
  AbortCode read(Address address, std::vector<std::uint8_t>& bytes) const;
  /// What others write: access, length, range and check decide.
  AbortCode write(Address address, std::span<const std::uint8_t> bytes);
  /// Whether others may write it at all, before its bytes are there.
  AbortCode may_be_written(Address address) const;

 private:
  AbortCode missing(Address address) const noexcept;

  std::map<Address, Entry> entries_;
};

}  // namespace armature::canopen
