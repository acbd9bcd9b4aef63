// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "drives/canopen/device.hpp"

namespace armature::canopen::internal {

/// Objects that one of a device's PDOs carries at most.
constexpr std::uint8_t kMostEntries = 8;

/// The objects 0x1000 to 0x1018 of a device.
void add_device_objects(ObjectDictionary& dictionary, NodeId node, std::uint32_t device_type,
                        const Identity& identity, const std::string& name);

/// Communication and mapping parameters of a PDO, switched off and empty.
void add_pdo_objects(ObjectDictionary& dictionary, NodeId node, PdoDirection direction,
                     unsigned number);

}  // namespace armature::canopen::internal
