// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/internal/device_objects.hpp"

#include <string>

#include "drives/canopen/device.hpp"
#include "drives/canopen/sdo_channel.hpp"

namespace armature::canopen::internal {
namespace {

std::span<const std::uint8_t> bytes_of_text(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void add_identity(ObjectDictionary& dictionary, const Identity& identity) {
  dictionary.add_count(0x1018, "Identity object", 4);
  const auto add = [&](std::uint8_t subindex, const char* name, std::uint32_t value) {
    dictionary.add({.address = {0x1018, subindex}, .name = name, .access = Access::kReadOnly},
                   value);
  };
  add(1, "Vendor-ID", identity.vendor);
  add(2, "Product code", identity.product);
  add(3, "Revision number", identity.revision);
  add(4, "Serial number", identity.serial);
}

}  // namespace

void add_device_objects(ObjectDictionary& dictionary, NodeId node, std::uint32_t device_type,
                        const Identity& identity, const std::string& name) {
  dictionary.add({.address = {0x1000, 0}, .name = "Device type", .access = Access::kReadOnly},
                 device_type);
  dictionary.add({.address = {0x1001, 0},
                  .name = "Error register",
                  .type = DataType::kUnsigned8,
                  .access = Access::kReadOnly,
                  .mappable = true});
  dictionary.add_count(0x1003, "Pre-defined error field", 0, Access::kReadWrite);
  dictionary.set_check({0x1003, 0}, [](std::uint64_t count) {
    return count == 0 ? AbortCode::kNone : AbortCode::kInvalidValue;  // it can only be cleared
  });
  dictionary.add(
      {.address = {0x1003, 1}, .name = "Standard error field", .access = Access::kReadOnly});
  dictionary.add({.address = {0x1005, 0}, .name = "COB-ID SYNC message"}, cob_id::kSync);
  dictionary.add({.address = {0x1006, 0}, .name = "Communication cycle period"});
  dictionary.add({.address = {0x1019, 0},
                  .name = "Synchronous counter overflow value",
                  .type = DataType::kUnsigned8,
                  .high = 240});
  dictionary.add_bytes({.address = {0x1008, 0},
                        .name = "Manufacturer device name",
                        .type = DataType::kVisibleString,
                        .access = Access::kConstant},
                       bytes_of_text(name));
  dictionary.add({.address = {0x1014, 0}, .name = "COB-ID EMCY", .access = Access::kReadOnly},
                 cob_id::emergency(node));
  dictionary.add_count(0x1016, "Consumer heartbeat time", 1);
  dictionary.add({.address = {0x1016, 1}, .name = "Consumer heartbeat time"});
  dictionary.add(
      {.address = {0x1017, 0}, .name = "Producer heartbeat time", .type = DataType::kUnsigned16});
  add_identity(dictionary, identity);
}

void add_pdo_objects(ObjectDictionary& dictionary, NodeId node, PdoDirection direction,
                     unsigned number) {
  const std::string name = std::string(to_text(direction)) + std::to_string(number);
  const std::uint16_t communication = communication_index(direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  const std::uint32_t cob_id = direction == PdoDirection::kReceive
                                   ? cob_id::receive_pdo(number, node)
                                   : cob_id::transmit_pdo(number, node);
  dictionary.add_count(communication, name + " communication parameter", 5);
  dictionary.add({.address = {communication, 1}, .name = "COB-ID"}, cob_id | kCobIdInvalid);
  dictionary.add(
      {.address = {communication, 2}, .name = "Transmission type", .type = DataType::kUnsigned8},
      transmission::kProfilesEvent);
  dictionary.add(
      {.address = {communication, 3}, .name = "Inhibit time", .type = DataType::kUnsigned16});
  dictionary.add(
      {.address = {communication, 5}, .name = "Event timer", .type = DataType::kUnsigned16});
  dictionary.add_count(mapping, name + " mapping parameter", 0, Access::kReadWrite);
  for (std::uint8_t i = 1; i <= kMostEntries; ++i) {
    dictionary.add({.address = {mapping, i}, .name = "Mapped object " + std::to_string(i)});
  }
}

}  // namespace armature::canopen::internal
