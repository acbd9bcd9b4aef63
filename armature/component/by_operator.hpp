// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::component {

/// Option of an operation, command or property: an act of the operator. Scripts and other processes
/// may call or set it only if the deployment grants it; a file may not give such a property another
/// value than its default.
struct ByOperator {};
inline constexpr ByOperator by_operator{};

}  // namespace armature::component
