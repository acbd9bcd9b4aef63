// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/registry.hpp"

namespace armature::inspect {

/// One line for each model: name, granularity, library, what it is.
std::string list_models(const component::Registry& registry);

/// Ports, properties, operations, commands, events and requirements of a model, for people. The
/// error of an unknown name suggests a near one.
base::Result<std::string> describe_model(const component::Registry& registry,
                                         std::string_view name);

/// The same of a component that no model has, as its members are now.
std::string describe_members(const component::Component& component);

/// The same for machines: a JSON array with an object for each of `names`, all models if empty.
/// @param indent  -1: all on one line
base::Result<std::string> models_as_json(const component::Registry& registry,
                                         const std::vector<std::string>& names = {},
                                         int indent = 2);

}  // namespace armature::inspect
