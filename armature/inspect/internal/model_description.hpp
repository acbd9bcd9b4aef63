// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/result.hpp"
#include "armature/component/registry.hpp"
#include "armature/inspect/describe.hpp"

namespace armature::inspect::internal {

/// Makes a component of the model and describes it; the error says if its constructor throws or it
/// declares a unit that there is not.
base::Result<ComponentDescription> describe_model(const component::Registry::Model& model);

/// The model of that name; the error suggests a near one.
base::Result<const component::Registry::Model*> find_model(const component::Registry& registry,
                                                           std::string_view name);

}  // namespace armature::inspect::internal
