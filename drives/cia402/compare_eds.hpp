// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"
#include "drives/canopen/eds.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {

/// Compares a drive with the EDS that is said to describe it: vendor, product and revision, where
/// the file has them, and whether each object that this host uses is there with as many bytes.
/// @param file  of the EDS, for messages
/// @return false after an error; each names the drive, the object, what was expected and found
bool compare_with_eds(canopen::SdoChannel& channel, const canopen::Eds& eds,
                      const std::string& file, const DriveWish& wish,
                      base::Diagnostics& diagnostics);

}  // namespace armature::cia402
