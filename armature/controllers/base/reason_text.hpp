// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/outcome.hpp"

namespace armature::controllers {

/// Appends the shortest text that reads as `number` again, "nan" and "inf" too.
/// @rt nonblocking, no allocation
component::Reason& append_number(component::Reason& reason, double number);

}  // namespace armature::controllers
