// SPDX-License-Identifier: Apache-2.0
#pragma once

// A running application as the structs of inspection.idl have it, for tools of this process and
// others. Include what is generated from it, inspection_types.hpp, to use what comes back.

#include <functional>
#include <string>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/exec/application.hpp"
#include "armature/types/type.hpp"

namespace armature::remote {

struct ApplicationStatus;
struct ComponentDetails;
struct ComponentStatus;
struct Faults;
struct ItemValue;

/// How values become text.
using ToText = std::function<std::string(const types::Type&, const void*)>;

/// @thread the controlling one, as for all below
ApplicationStatus status_of(exec::Application& application);

/// Why it does not run is asked in its thread.
ComponentStatus status_of(exec::Application& application, component::Component& component);

using Components = std::vector<component::Component*>;
/// In the order of the deployment.
Components all_components(const exec::Application& application);
std::vector<ComponentStatus> statuses_of(exec::Application& application,
                                         const Components& components);
/// Those of `components` that do not run.
Faults faults_of(exec::Application& application, const Components& components);

/// Everything about a component, with its values, which its thread copies at one moment.
/// @param to_text  none: without values, and without asking its thread
ComponentDetails details_of(exec::Application& application, component::Component& component,
                            const ToText& to_text = types::to_text);

/// Values by their items, such as `Sensor.sensor[2]`: of each component all at one moment.
std::vector<ItemValue> values_of(exec::Application& application,
                                 const std::vector<std::string>& items,
                                 const ToText& to_text = types::to_text);

}  // namespace armature::remote
