// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"

/// Values as JSON objects, which is what viewers want: a struct is itself one, any other value is
/// the member `value` of one. Numbers are exact. JSON has no nan, which is written as null, and no
/// infinity, which is written as 1e999: parsers round that to infinity. A byte of a text that is
/// not UTF-8 becomes a question mark.
namespace armature::record {

std::string to_json(const types::Type& type, const void* value);

/// Reads what `to_json` writes, with the fields of a struct in their order. An error says at which
/// byte what was expected, and leaves `value` as it was.
base::Result<void> from_json(const types::Type& type, std::string_view json, void* value);

/// The JSON Schema of what `to_json` writes; a field's documentation and unit are its description.
std::string json_schema(const types::Type& type);
/// Its name: that of the type, or of a schema that Foxglove knows (ros_types.hpp).
std::string json_schema_name(const types::Type& type);

}  // namespace armature::record
