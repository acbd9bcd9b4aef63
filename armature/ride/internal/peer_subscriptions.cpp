// SPDX-License-Identifier: Apache-2.0
// Of PeerState: what threads of the program ask of it, and the events they get.
#include <algorithm>
#include <chrono>
#include <future>
#include <tuple>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node/node_state.hpp"
#include "armature/ride/internal/peer_state.hpp"

namespace armature::ride::internal {

base::Result<void> PeerState::wait_until_connected(base::Duration limit) const {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, limit, [this] { return connected(); })) return {};
  return base::Error{"'" + text_ + "' is not connected: " +
                     (problem_.empty() ? std::string("it has not answered yet") : problem_)};
}

base::Result<std::vector<PeerComponent>> PeerState::components(base::Duration limit) {
  using Listed = base::Result<std::vector<PeerComponent>>;
  if (const auto there = wait_until_connected(limit); !there) return base::Error{there.error()};
  const auto listed = std::make_shared<std::promise<Listed>>();
  std::future<Listed> answer = listed->get_future();
  auto take = [listed, peer = text_](Code code, std::string_view text,
                                     std::span<const std::byte> result) {
    std::vector<ComponentEntry> entries;
    Decoder from(result);
    if (code != Code::kNone || !from.take(entries) || !from.ended()) {
      return listed->set_value(base::Error{"'" + peer + "' does not list its components: " +
                                           std::string(name_of(code)) + " " + std::string(text)});
    }
    std::vector<PeerComponent> components;
    for (const ComponentEntry& entry : entries) components.push_back({entry.name, entry.interface});
    listed->set_value(std::move(components));
  };
  run([&, take = std::move(take)]() mutable {
    const std::tuple<> none;
    ask_the_directory(kList, Fields(none), std::move(take));
  });
  const base::Error no_answer{"'" + text_ + "' does not list its components in time"};
  if (answer.wait_for(limit) != std::future_status::ready) return no_answer;
  try {
    return answer.get();
  } catch (const std::future_error&) {  // the connection was lost, and the question with it
    return no_answer;
  }
}

Subscription PeerState::on_change(std::function<void(const PeerChange&)> handler) {
  std::uint64_t id = 0;
  run([&] {
    id = ++last_handler_;
    change_handlers_.push_back(
        std::make_shared<ChangeHandler>(ChangeHandler{id, std::move(handler)}));
  });
  return end_of(id);
}

Subscription PeerState::end_of(std::uint64_t handler) {
  return Subscription([self = weak_from_this(), handler] {
    if (const auto peer = self.lock()) peer->run([&] { peer->unsubscribe(handler); });
  });
}

void PeerState::tell(const PeerChange& change) {
  const auto handlers = change_handlers_;  // One may end itself.
  for (const auto& handler : handlers) handler->call(change);
}

std::shared_ptr<RemoteComponent> PeerState::component(std::string name,
                                                      const Interface& interface) {
  std::shared_ptr<RemoteComponent> component;
  run([&] {
    const auto known = std::ranges::find_if(components_, [&](const auto& other) {
      return other->name == name && other->interface == &interface;
    });
    if (known != components_.end()) {
      component = *known;
      return;
    }
    component = std::make_shared<RemoteComponent>();
    component->name = std::move(name);
    component->interface = &interface;
    components_.push_back(component);
    if (up_) look_up(component);
  });
  wait_until_looked_up(*component, std::chrono::seconds(1));
  return component;
}

/// Whoever makes a placeholder of a peer that is there can use it at once.
void PeerState::wait_until_looked_up(const RemoteComponent& component, base::Duration limit) {
  if (node_ == nullptr || node_->in_io_thread()) return;
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, limit, [&] {
    return !link_->open() || component.state.load() != RemoteComponent::State::kUnknown;
  });
}

void PeerState::request(RemoteComponent& component, Number operation, const CallOptions& options,
                        const Fields& parameters, WaitingCall& call) {
  CallOptions left = options;
  if (component.state.load() == RemoteComponent::State::kUnknown) {
    const base::Time before = platform::monotonic_now();
    wait_until_looked_up(component, options.deadline);
    left.deadline -= std::min(platform::monotonic_now() - before, options.deadline);
  }
  link_->call(operation, Recipient(component.identifier), left, parameters, call);
  if (call.code != Code::kNotConnected) return;
  if (component.state.load() == RemoteComponent::State::kMissing) {
    call.code = Code::kNoSuchComponent;
    call.text = "no component of this name has this interface";
    return;
  }
  const std::lock_guard lock(mutex_);
  call.text = "not connected: " + (problem_.empty() ? "it has not answered yet" : problem_);
}

Subscription PeerState::subscribe(std::shared_ptr<RemoteComponent> component, Number event,
                                  std::function<bool(Decoder&)> handler) {
  std::uint64_t id = 0;
  run([&] {
    id = ++last_handler_;
    auto at = std::ranges::find_if(subscriptions_, [&](const auto& other) {
      return other->component->name == component->name && other->event == event;
    });
    if (at == subscriptions_.end()) {
      subscriptions_.push_back(std::make_unique<WireSubscription>(
          WireSubscription{++last_subscription_, component, event, {}, false}));
      at = std::prev(subscriptions_.end());
    }
    (*at)->handlers.push_back(std::make_shared<Handler>(Handler{id, std::move(handler)}));
    if (up_) send_subscription(**at);
  });
  return end_of(id);
}

void PeerState::send_subscription(WireSubscription& subscription) {
  const std::uint32_t identifier = subscription.component->identifier.load();
  if (subscription.sent || identifier == 0) return;
  subscription.sent = true;
  link_->set_listens(true);
  const auto component = static_cast<std::int32_t>(identifier);
  const auto chosen = static_cast<std::int32_t>(subscription.id);
  const auto parameters = std::tie(component, subscription.event, chosen);
  ask_the_directory(kSubscribe, Fields(parameters),
                    [this, name = subscription.component->name](Code code, std::string_view text,
                                                                std::span<const std::byte> result) {
                      std::int32_t refusal = 0;
                      Decoder from(result);
                      if (code == Code::kNone && from.take(refusal) && refusal == 0) return;
                      if (code == Code::kNone) code = static_cast<Code>(refusal);
                      node_->journal().tell(rt::LogLevel::kError,
                                            "{} refuses a subscription to an event of '{}': {} {}",
                                            text_, name, name_of(code), text);
                    });
}

void PeerState::unsubscribe(std::uint64_t handler) {
  std::erase_if(change_handlers_, [&](const auto& other) { return other->id == handler; });
  for (const auto& subscription : subscriptions_) {
    for (auto& other : subscription->handlers) {
      if (other != nullptr && other->id == handler) other = nullptr;
    }
  }
  if (!delivering_) remove_unused();
}

/// Takes away handlers that have ended, and subscriptions without any.
void PeerState::remove_unused() {
  for (const auto& subscription : subscriptions_) {
    std::erase(subscription->handlers, nullptr);
    if (!subscription->handlers.empty() || !subscription->sent) continue;
    const auto chosen = static_cast<std::int32_t>(subscription->id);
    const auto parameters = std::tie(chosen);
    ask_the_directory(kUnsubscribe, Fields(parameters),
                      [](Code, std::string_view, std::span<const std::byte>) {});
  }
  std::erase_if(subscriptions_, [](const auto& other) { return other->handlers.empty(); });
  if (subscriptions_.empty()) link_->set_listens(false);
}

void PeerState::take_event(const Message& message) {
  const auto at = std::ranges::find(subscriptions_, message.header.identifier,
                                    [](const auto& subscription) { return subscription->id; });
  if (at == subscriptions_.end()) return;  // One of before its subscription ended.
  WireSubscription& subscription = **at;
  delivering_ = true;
  bool well_formed = true;
  for (std::size_t i = 0; i < subscription.handlers.size() && well_formed; ++i) {
    const auto handler = subscription.handlers[i];
    Decoder members(message.body);
    Number event = 0;
    if (handler == nullptr) continue;
    well_formed = members.take(event) && event == subscription.event && handler->call(members);
  }
  delivering_ = false;
  remove_unused();
  if (!well_formed) link_->refuse(Code::kMalformed, message, "the event has no subscription");
}

}  // namespace armature::ride::internal
