// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "armature/base/diagnostic.hpp"
#include "armature/platform/thread.hpp"

namespace armature::can::internal {

/// Starts the thread that says when a bus has news; what it is not granted is a warning.
/// @param bus  its name
std::unique_ptr<platform::Thread> start_watcher(const std::string& bus,
                                                const platform::ThreadRequest& request,
                                                std::function<void()> watch,
                                                base::Diagnostics& diagnostics);

}  // namespace armature::can::internal
