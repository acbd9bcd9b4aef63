// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <unordered_map>

#include "armature/base/diagnostic.hpp"
#include "armature/component/component.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy::internal {

/// Those of a blueprint by their names.
using Components = std::unordered_map<std::string_view, const component::Component*>;

/// nullptr if none has that name.
const component::Component* find_component(const Components& components, std::string_view name);

/// The component that an end names; nullptr if a mistake was told, or it could not be made, which
/// was told before.
const component::Component* component_at(const document::Endpoint& end,
                                         const Components& components,
                                         const exec::Blueprint& blueprint,
                                         base::Diagnostics& diagnostics);

}  // namespace armature::deploy::internal
