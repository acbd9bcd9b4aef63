// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace armature::base {

/// `text` for a terminal, which it cannot command: control characters, characters that turn the
/// direction of text, and bytes that are not UTF-8 are written out as `\x1b` or `\u202e`.
/// Tabs and line ends stay.
std::string visible_text(std::string_view text);

}  // namespace armature::base
