// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drives/canopen/object_dictionary.hpp"
#include "drives/cia402/scaling.hpp"

namespace armature::cia402::internal {

/// The objects of an emulated drive by CiA 402, with values to begin with.
void add_drive_objects(canopen::ObjectDictionary& dictionary, const Factors& factors,
                       const Scaling& scaling);

}  // namespace armature::cia402::internal
