// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/service.hpp"

#include <utility>

#include "armature/ride/internal/link.hpp"
#include "armature/ride/internal/publisher.hpp"

namespace armature::ride {

PendingReply::PendingReply(PendingReply&& other) noexcept
    : holding_(std::move(other.holding_)),
      link_(std::exchange(other.link_, nullptr)),
      connection_(other.connection_),
      call_(other.call_),
      priority_(other.priority_),
      operation_(other.operation_),
      component_(other.component_) {}

PendingReply& PendingReply::operator=(PendingReply&& other) noexcept {
  PendingReply taken(std::move(other));
  std::swap(holding_, taken.holding_);
  std::swap(link_, taken.link_);
  std::swap(connection_, taken.connection_);
  std::swap(call_, taken.call_);
  std::swap(priority_, taken.priority_);
  std::swap(operation_, taken.operation_);
  std::swap(component_, taken.component_);
  return *this;
}

PendingReply::~PendingReply() { fail("the component dropped the request without an answer"); }

void PendingReply::answer(const Fields& result) {
  if (link_ == nullptr) return;
  if (link_->connection_number() == connection_) {
    link_->send(priority_, Type::kReply, internal::Recipient(call_), {}, result,
                internal::Link::Flush::kNow);
  }
  link_->reply_was_given();
  link_ = nullptr;
}

void PendingReply::fail(std::string_view text) {
  if (link_ == nullptr) return;
  if (link_->connection_number() == connection_) {
    link_->send_control(call_, {Code::kFailed, static_cast<std::uint32_t>(Type::kRequest),
                                component_, operation_, text});
  }
  link_->reply_was_given();
  link_ = nullptr;
}

/// The answer may be as large as the request, and so may the values: of the three the request goes
/// before the answer comes, so that the largest there may be has room.
void Reply::answer(const Fields& result) {
  if (std::exchange(settled_, true) || link_ == nullptr) return;
  if (parameters_ != nullptr && !parameters_->lends()) link_->waiting.let_go_of_popped();
  link_->send(priority_, Type::kReply, internal::Recipient(call_), {}, result,
              internal::Link::Flush::kNow);
}

PendingReply Reply::keep() {
  PendingReply kept;
  if (holding_ != nullptr) kept.holding_ = std::move(*holding_);
  if (std::exchange(settled_, true) || link_ == nullptr) return kept;
  kept.link_ = link_->shared_from_this();
  kept.connection_ = link_->connection_number();
  kept.call_ = call_;
  kept.priority_ = priority_;
  kept.operation_ = operation_;
  kept.component_ = component_;
  kept.link_->kept_replies.fetch_add(1, std::memory_order_relaxed);
  return kept;
}

Service::Service(const Interface& interface)
    : interface_(interface), publisher_(std::make_shared<internal::Publisher>(interface)) {}

Service::~Service() = default;

void Service::publish(Number event, const Fields& members, Priority priority) {
  publisher_->publish(event, members, priority);
}

std::uint64_t Service::subscription_changes() const { return publisher_->changes(); }
bool Service::has_subscribers(Number event) const { return publisher_->has_subscribers(event); }

}  // namespace armature::ride
