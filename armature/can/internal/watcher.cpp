// SPDX-License-Identifier: Apache-2.0
#include "armature/can/internal/watcher.hpp"

#include <utility>

namespace armature::can::internal {

std::unique_ptr<platform::Thread> start_watcher(const std::string& bus,
                                                const platform::ThreadRequest& request,
                                                std::function<void()> watch,
                                                base::Diagnostics& diagnostics) {
  auto watcher = std::make_unique<platform::Thread>(request, std::move(watch));
  for (const std::string& refusal : watcher->grant().refusals) {
    diagnostics.warning({}, "bus '" + bus + "': the thread that announces news: " + refusal);
  }
  return watcher;
}

}  // namespace armature::can::internal
