// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::wam {

/// The texts of wam4.urdf and wam7.urdf.
extern const char* const kWam4Urdf;
extern const char* const kWam7Urdf;

}  // namespace armature::wam
