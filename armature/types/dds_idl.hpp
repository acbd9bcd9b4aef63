// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"

namespace armature::types {

/// A type's name on DDS, as rosidl names types: `armature::msg::dds_::Pose_`. What is no struct is
/// a struct with the one member `data`: `vector<double>` is `armature::msg::dds_::Float64Vector_`.
std::string dds_name(const Type& type);

/// Why a type cannot be on DDS; empty if it can. Vectors of arrays cannot, nor texts that grow.
std::string dds_objection(const Type& type);

/// The OMG IDL of types and all types inside them, each once; enumerations are their integers, with
/// the names of the enumerators in a comment, as are units.
/// @param types  to which there is no objection
std::string dds_idl(std::span<const Type* const> types);

}  // namespace armature::types
