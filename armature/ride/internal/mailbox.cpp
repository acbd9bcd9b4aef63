// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/mailbox.hpp"

#include "armature/ride/internal/link.hpp"

namespace armature::ride::internal {

Mailbox::Letters::Letters() {
  flushes.reserve(kUsual);
  returns.reserve(kUsual);
}

bool Mailbox::post(std::function<void()>& task) {
  const std::lock_guard lock(mutex_);
  if (closed_) return false;
  letters_.tasks.push_back(std::move(task));
  has_letters_.store(true);
  return true;
}

void Mailbox::attend(std::shared_ptr<Link> link) {
  const std::lock_guard lock(mutex_);
  letters_.attention.push_back(std::move(link));
  has_letters_.store(true);
}

void Mailbox::flush(std::shared_ptr<Link> link) {
  const std::lock_guard lock(mutex_);
  letters_.flushes.push_back(std::move(link));
  has_letters_.store(true);
}

void Mailbox::take_back(std::shared_ptr<Link> link) {
  const std::lock_guard lock(mutex_);
  letters_.returns.push_back(std::move(link));
  has_letters_.store(true);
}

bool Mailbox::hand_over(Link& link, const Message& message) {
  const std::lock_guard lock(mutex_);
  const bool fits = !messages_.full();
  if (fits) messages_.push(link, message);
  has_messages_.store(true);
  return fits;
}

Mailbox::Letters& Mailbox::open() {
  const std::lock_guard lock(mutex_);
  has_letters_.store(false);
  std::swap(opened_, letters_);
  return opened_;
}

std::vector<std::function<void()>> Mailbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  return std::exchange(letters_.tasks, {});
}

}  // namespace armature::ride::internal
