// SPDX-License-Identifier: Apache-2.0
#include "armature/component/context.hpp"

#include <utility>

namespace armature::component {

ExecutionContext::ExecutionContext(std::string context_name) : name(std::move(context_name)) {
  limit_depth(kLeastDepthLimit);
}

ExecutionContext::~ExecutionContext() = default;

void ExecutionContext::limit_depth(int limit) {
  hooks = std::make_unique<HookEntrance[]>(static_cast<std::size_t>(limit));
  next_hook = hooks.get();
  end_of_hooks = hooks.get() + limit;
}

}  // namespace armature::component
