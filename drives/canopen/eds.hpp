// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "drives/canopen/cob_id.hpp"
#include "drives/canopen/device.hpp"
#include "drives/canopen/object.hpp"
#include "drives/canopen/object_dictionary.hpp"

namespace armature::canopen {

/// An object as an EDS or DCF describes it.
struct EdsObject {
  std::string name;
  DataType type = DataType::kUnsigned32;
  Access access = Access::kReadOnly;
  bool mappable = false;
  std::optional<std::int64_t> value = {};  ///< of a number: ParameterValue, else DefaultValue
  std::string text = {};                   ///< of anything else, as it is written
  std::optional<std::int64_t> low = {};
  std::optional<std::int64_t> high = {};

  friend bool operator==(const EdsObject&, const EdsObject&) = default;
};

/// What a device's maker (EDS) or its user (DCF) says of it.
struct Eds {
  std::string vendor_name = {};
  std::string product_name = {};
  Identity identity = {};  ///< vendor, product and revision by [DeviceInfo]; the serial number is 0
  std::optional<NodeId> node = {};  ///< of a DCF
  std::map<Address, EdsObject> objects = {};

  /// nullptr if there is none.
  const EdsObject* find(Address address) const;
  friend bool operator==(const Eds&, const Eds&) = default;
};

/// Reads an EDS or DCF (CiA 306-1): numbers are decimal, octal with 0 or hexadecimal with 0x, and
/// may add $NODEID; arrays may be compact (CompactSubObj, [xxxxName], [xxxxValue]).
/// @param file         for messages
/// @param node         for $NODEID; a DCF's own counts before it
/// @param diagnostics  has all mistakes, with their lines
/// @return none after an error
std::optional<Eds> parse_eds(std::string_view text, const std::string& file, NodeId node,
                             base::Diagnostics& diagnostics);

/// An EDS that `parse_eds` reads as `eds` again.
std::string to_text(const Eds& eds);

/// What a device's dictionary is as an EDS.
Eds describe(const ObjectDictionary& dictionary, std::string vendor_name, std::string product_name);

/// Adds the objects to a dictionary, with the values that they have.
void add_objects(const Eds& eds, ObjectDictionary& dictionary);

}  // namespace armature::canopen
