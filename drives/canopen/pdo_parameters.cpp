// SPDX-License-Identifier: Apache-2.0
// PDOs of a device as its objects describe them.
#include <string>
#include <utility>
#include <vector>

#include "drives/canopen/sdo_channel.hpp"

namespace armature::canopen {
namespace {

constexpr std::uint8_t kCobIdSub = 1;
constexpr std::uint8_t kTransmissionSub = 2;
constexpr std::uint8_t kInhibitSub = 3;
constexpr std::uint8_t kEventSub = 5;

/// Reads or writes one thing after the other, until one fails.
class Steps {
 public:
  explicit Steps(SdoChannel& channel) : channel_(channel) {}

  std::int64_t read(Address address, DataType type) {
    if (!result_) return 0;
    const auto value = channel_.read(address, type);
    if (value) return value.value();
    result_ = base::Error{value.error()};
    return 0;
  }
  /// 0 if the device has not got it.
  std::int64_t read_optional(Address address, DataType type) {
    if (!result_) return 0;
    const auto value = channel_.read(address, type);
    return value ? value.value() : 0;
  }
  void write(Address address, DataType type, std::int64_t value) {
    if (result_) result_ = channel_.write(address, type, value);
  }
  const base::Result<void>& result() const { return result_; }

 private:
  SdoChannel& channel_;
  base::Result<void> result_;
};

/// Whether the device has these objects in the PDO already; the mapping of many cannot be changed.
bool is_mapped(SdoChannel& channel, std::uint16_t mapping,
               const std::vector<MappedObject>& objects) {
  const auto count = channel.read({mapping, 0}, DataType::kUnsigned8);
  if (!count || !std::cmp_equal(count.value(), objects.size())) return false;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto entry =
        channel.read({mapping, static_cast<std::uint8_t>(i + 1)}, DataType::kUnsigned32);
    if (!entry || entry.value() != std::int64_t{mapping_entry(objects[i])}) return false;
  }
  return true;
}

void write_mapping(Steps& steps, std::uint16_t mapping, const std::vector<MappedObject>& objects) {
  steps.write({mapping, 0}, DataType::kUnsigned8, 0);
  std::uint8_t count = 0;
  for (const MappedObject& object : objects) {
    steps.write({mapping, ++count}, DataType::kUnsigned32, mapping_entry(object));
  }
  steps.write({mapping, 0}, DataType::kUnsigned8, count);
}

}  // namespace

base::Result<Pdo> read_pdo(SdoChannel& channel, PdoDirection direction, unsigned number) {
  const std::uint16_t communication = communication_index(direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  Steps steps(channel);
  Pdo pdo;
  const auto cob_id =
      static_cast<std::uint32_t>(steps.read({communication, kCobIdSub}, DataType::kUnsigned32));
  pdo.cob_id = cob_id & kCobIdMask;
  pdo.valid = (cob_id & kCobIdInvalid) == 0;
  pdo.transmission = static_cast<std::uint8_t>(
      steps.read({communication, kTransmissionSub}, DataType::kUnsigned8));
  pdo.inhibit_100us = static_cast<std::uint16_t>(
      steps.read_optional({communication, kInhibitSub}, DataType::kUnsigned16));
  pdo.event_ms = static_cast<std::uint16_t>(
      steps.read_optional({communication, kEventSub}, DataType::kUnsigned16));
  const std::int64_t count = steps.read({mapping, 0}, DataType::kUnsigned8);
  for (std::int64_t i = 1; i <= count && std::cmp_less_equal(i, kMostMappedObjects); ++i) {
    pdo.objects.push_back(mapped_object(static_cast<std::uint32_t>(
        steps.read({mapping, static_cast<std::uint8_t>(i)}, DataType::kUnsigned32))));
  }
  if (!steps.result()) return base::Error{steps.result().error()};
  if (const auto checked = check_mapping(pdo.objects); !checked) {
    return base::Error{std::string(to_text(direction)) + std::to_string(number) + ": " +
                       checked.error()};
  }
  return pdo;
}

base::Result<void> write_pdo(SdoChannel& channel, PdoDirection direction, unsigned number,
                             const Pdo& pdo) {
  if (auto checked = check_mapping(pdo.objects); !checked) return checked;
  const std::uint16_t communication = communication_index(direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  Steps steps(channel);
  steps.write({communication, kCobIdSub}, DataType::kUnsigned32, pdo.cob_id | kCobIdInvalid);
  if (!is_mapped(channel, mapping, pdo.objects)) write_mapping(steps, mapping, pdo.objects);
  steps.write({communication, kTransmissionSub}, DataType::kUnsigned8, pdo.transmission);
  if (pdo.inhibit_100us > 0) {
    steps.write({communication, kInhibitSub}, DataType::kUnsigned16, pdo.inhibit_100us);
  }
  if (pdo.event_ms > 0) {
    steps.write({communication, kEventSub}, DataType::kUnsigned16, pdo.event_ms);
  }
  if (pdo.valid) steps.write({communication, kCobIdSub}, DataType::kUnsigned32, pdo.cob_id);
  return steps.result();
}

}  // namespace armature::canopen
