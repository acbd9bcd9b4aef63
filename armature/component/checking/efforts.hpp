// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::component {

class OperationBase;
class PortBase;

// Efforts are voltages, currents, forces, torques and powers, whatever the prefix, and what only a
// joint's limiter makes: what moves a robot if it gets to hardware.

/// Whether the port has an effort, in whatever depth of its type.
/// @thread configuration only
bool has_effort(const PortBase& port);
/// Whether an argument is one.
/// @thread configuration only
bool takes_effort(const OperationBase& operation);

}  // namespace armature::component
