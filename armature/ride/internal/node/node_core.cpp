// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/node_core.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {
namespace {

std::unique_ptr<platform::Poller> make_poller(const std::string& node) {
  auto poller = platform::Poller::make();
  if (!poller) throw std::runtime_error("node '" + node + "': " + poller.error());
  return std::move(poller).value();
}

}  // namespace

NodeStatistics Counters::statistics(std::uint64_t memory_bytes) const {
  const auto get = [](const Counter& counter) { return counter.load(std::memory_order_relaxed); };
  return {get(connections),     get(connections_refused), get(messages),  get(refusals),
          get(commands_failed), get(events_dropped),      get(throttled), memory_bytes};
}

NodeCore::NodeCore(NodeOptions given)
    : options(std::move(given)),
      memory(std::make_shared<MemoryBound>(options.limits.memory_bytes,
                                           options.limits.connections * Link::kReserve)),
      journal(options.name, options.log),
      poller(make_poller(options.name)) {}

}  // namespace armature::ride::internal
