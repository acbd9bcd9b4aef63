// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "armature/base/diagnostic.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/document/document.hpp"
#include "armature/types/type.hpp"

namespace armature::document {

/// What a user wrote, as a value of `type`. A number with a unit is converted into `unit`, one
/// without is taken as given in it; integers must come out whole and in range; lists fill arrays
/// and vectors, maps fill structs, whose fields have their own units.
/// @param subject  begins each message: `property 'Kp' of 'PID1'`
/// @return nothing if there was a mistake; every one is added to `diagnostics` at its place
std::optional<types::Value> make_value(const Value& written, const types::Type& type,
                                       std::string_view unit, std::string_view subject,
                                       base::Diagnostics& diagnostics);

/// The inverse: what a file says for a value of `type`, in its own unit.
Value write_value(const types::Type& type, const void* value);

/// Sets a property to what a user wrote; false if a mistake was added to `diagnostics`.
bool set_property(component::PropertyBase& property, const Value& written,
                  base::Diagnostics& diagnostics);

}  // namespace armature::document
