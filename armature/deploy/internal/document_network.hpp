// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/deploy/document.hpp"
#include "armature/deploy/internal/fields.hpp"

namespace armature::deploy::internal {

/// The section `network`; what is wrong with it is told by `reader`.
Network read_network(const Value& value, const ValueReader& reader);

}  // namespace armature::deploy::internal
