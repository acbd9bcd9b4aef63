// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/handshakes.hpp"

#include <utility>

#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {

void Handshakes::add(std::shared_ptr<Link> link) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(link));
  }
  changed_.notify_one();
  if (thread_ != nullptr) return;
  platform::ThreadRequest request;
  request.name = name_;
  request.prefault = false;  // Like the node's: a small server is to stay small.
  thread_ = std::make_unique<platform::Thread>(request, [this] { run(); });
}

void Handshakes::stop() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.reset();
  for (const auto& link : std::exchange(waiting_, {})) link->let_go();
}

std::shared_ptr<Link> Handshakes::wait_for_next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
  if (ends_) return nullptr;
  auto next = std::move(waiting_.front());
  waiting_.pop_front();
  return next;
}

void Handshakes::run() {
  while (const auto link = wait_for_next()) done_(link, link->establish());
}

}  // namespace armature::ride::internal
