// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/age_watch.hpp"

#include <algorithm>

#include "armature/platform/clock.hpp"

namespace armature::exec::internal {
namespace {

constexpr std::size_t kStack = 64 * 1024;

}  // namespace

AgeWatch::AgeWatch(const std::vector<std::unique_ptr<Engine>>& engines, bool realtime) {
  request_.name = "ages";
  request_.stack_bytes = kStack;
  request_.prefault = realtime;
  for (const auto& engine : engines) {
    if (!engine->sleeps_until_ages()) continue;
    engine->be_woken_by(alarms_);
    const bool urgent = engine->activity().scheduler != Activity::Scheduler::kOther;
    if (!realtime || !urgent) continue;
    request_.scheduler = platform::Scheduler::kFifo;
    request_.priority = std::max({request_.priority, engine->activity().priority, 1});
  }
  if (!alarms_->empty()) thread_.emplace(request_, [this] { serve(); });
}

AgeWatch::~AgeWatch() {
  ending_.store(true, std::memory_order_release);
  alarms_->wake_watch();
}

void AgeWatch::serve() {
  while (!ending_.load(std::memory_order_acquire)) {
    alarms_->wait_until(alarms_->ring(platform::monotonic_now()));
  }
}

}  // namespace armature::exec::internal
