// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/rtai_priorities.hpp"

#include <algorithm>
#include <string>

#include "armature/document/value_tree.hpp"

namespace armature::deploy::internal {

using namespace document;

RtaiPriorities::RtaiPriorities(const Document& document, base::Diagnostics& diagnostics) {
  if (document.priorities != Priorities::kRtai) return;
  for (const Component& component : document.components) {
    const Activity& activity = component.activity;
    if (activity.priority > 0) here_.emplace(activity.priority, 0);
    const bool needs_one = activity.owns_thread() && !activity.scheduler_given;
    if (!needs_one || activity.priority > 0) continue;
    diagnostics.error(
        activity.where,
        in_quotes(component.name) + " has a thread without a priority, but priorities are RTAI's",
        "give it one, priority: 1..255, 1 is the most urgent, or scheduler: other");
  }
  int next = kFirst;
  for (auto& [rtai, here] : here_) here = std::max(1, next--);
  if (next >= 0) return;
  diagnostics.error({document.file, 0, 0}, "the file has " + std::to_string(here_.size()) +
                                               " different priorities of RTAI, expected at most " +
                                               std::to_string(kFirst));
}

int RtaiPriorities::here(int priority) const {
  const auto found = here_.find(priority);
  return found == here_.end() ? priority : found->second;
}

}  // namespace armature::deploy::internal
