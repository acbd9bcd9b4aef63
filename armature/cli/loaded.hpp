// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/diagnostic.hpp"

namespace armature::cli {

/// A function of one of our libraries that is loaded here, when it is wanted, and not with the
/// program: a running application locks all memory, and most runs do without.
/// @param library  such as `libarmature_lua.so`; it stays
/// @param needs    who cannot do without it, for the error: `scripts need`
/// @return nullptr after an error
void* load_function(const std::string& library, const char* function, const std::string& needs,
                    base::Diagnostics& diagnostics);

}  // namespace armature::cli
