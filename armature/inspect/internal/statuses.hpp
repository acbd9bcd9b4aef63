// SPDX-License-Identifier: Apache-2.0
#pragma once

// How an application and its components stand, as its controlling thread finds out.

#include <string>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/exec/application.hpp"
#include "armature/inspect/status.hpp"

namespace armature::inspect::internal {

/// `every 10 ms`, `triggered`.
std::string activity_text(const exec::Activity& activity);

/// The thread that runs a component.
const exec::ThreadPlan& thread_of(const exec::Application& application,
                                  const component::Component& component);

/// @thread the controlling one, as for all below
ApplicationStatus status_of(exec::Application& application);

/// Asks no thread, so the reason is left out.
ComponentStatus status_without_reason(const exec::Application& application,
                                      const component::Component& component);

/// Why components do not run is asked in their threads: each thread is asked once, so that one that
/// hangs is waited for once.
std::vector<ComponentStatus> statuses_of(exec::Application& application,
                                         const std::vector<component::Component*>& components);

}  // namespace armature::inspect::internal
