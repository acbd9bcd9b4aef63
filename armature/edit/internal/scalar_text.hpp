// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/document/document.hpp"
#include "armature/edit/source_text.hpp"

namespace armature::edit::internal {

/// A value on one line, as it may stand in block style: texts need fewer quotes there than in
/// brackets.
std::string written_in_block(const document::Value& value);

/// A value on one line, as it may stand in brackets.
std::string written_in_flow(const document::Value& value);

/// A value in place of `node`, in its kind of quotes.
std::string text_in_place_of(const Node& node, const document::Value& value);

}  // namespace armature::edit::internal
