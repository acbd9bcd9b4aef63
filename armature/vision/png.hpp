// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/vision/image.hpp"

namespace armature::vision {

/// The bytes of a PNG file (ISO/IEC 15948): 8 bits, RGB.
std::string png_of(const ImageView& image);

}  // namespace armature::vision
