// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace armature::base {

/// With `&amp;`, `&lt;`, `&gt;` and `&quot;` for what XML reads as its own.
std::string xml_escaped(std::string_view text);

}  // namespace armature::base
