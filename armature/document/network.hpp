// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/document/document.hpp"
#include "armature/document/fields.hpp"

namespace armature::document {

/// The section `network`; what is wrong with it is told by `reader`.
Network read_network(const Value& value, const ValueReader& reader);

}  // namespace armature::document
