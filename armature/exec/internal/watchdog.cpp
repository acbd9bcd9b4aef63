// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/watchdog.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

#include "armature/platform/thread.hpp"

namespace armature::exec::internal {
namespace {

struct Progress {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t done = 0;
  bool finished = false;
};

void run_all(Progress& progress, std::size_t count, const std::function<bool(std::size_t)>& each) {
  bool go_on = true;
  for (std::size_t i = 0; i < count && go_on; ++i) {
    go_on = each(i);
    const std::lock_guard lock(progress.mutex);
    ++progress.done;
  }
  const std::lock_guard lock(progress.mutex);
  progress.finished = true;
  progress.changed.notify_all();
}

}  // namespace

WatchedRun run_watched(std::size_t count, base::Duration limit,
                       std::function<bool(std::size_t)> each) {
  const auto progress = std::make_shared<Progress>();
  platform::ThreadRequest request;
  request.name = "life cycle";
  constexpr std::size_t kHookStack = 8u << 20;  // like a main thread's: hooks load files and models
  request.stack_bytes = kHookStack;
  request.prefault = false;
  platform::Thread thread(
      request, [progress, count, each = std::move(each)] { run_all(*progress, count, each); });
  std::unique_lock lock(progress->mutex);
  std::size_t seen = 0;
  while (!progress->finished) {
    const bool finished =
        progress->changed.wait_for(lock, limit, [&] { return progress->finished; });
    if (finished || progress->done != seen) {
      seen = progress->done;
      continue;
    }
    thread.abandon();
    return {progress->done, true};
  }
  return {progress->done, false};
}

}  // namespace armature::exec::internal
