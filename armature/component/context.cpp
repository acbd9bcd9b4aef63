// SPDX-License-Identifier: Apache-2.0
#include "armature/component/context.hpp"

#include <utility>

namespace armature::component {

ExecutionContext::ExecutionContext(std::string context_name) : name(std::move(context_name)) {
  limit_depth(kLeastDepthLimit);
}

ExecutionContext::~ExecutionContext() = default;

LaneTo::LaneTo(rt::Outbox& writers_outbox, ExecutionContext& reading)
    : outbox(writers_outbox), reader(reading), lane(reading.inbox) {}

LaneTo& ExecutionContext::lane_to(ExecutionContext& reader) {
  for (const std::unique_ptr<LaneTo>& lane : lanes) {
    if (&lane->reader == &reader) return *lane;
  }
  return *lanes.emplace_back(std::make_unique<LaneTo>(outbox, reader));
}

void ExecutionContext::limit_depth(int limit) {
  hooks = std::make_unique<HookEntrance[]>(static_cast<std::size_t>(limit));
  next_hook = hooks.get();
  end_of_hooks = hooks.get() + limit;
}

}  // namespace armature::component
