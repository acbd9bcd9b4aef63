// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/peer_state.hpp"

#include <algorithm>
#include <chrono>
#include <random>
#include <tuple>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/node/node_state.hpp"

namespace armature::ride::internal {
namespace {

/// What is not there yet is looked for so often.
constexpr base::Duration kAskAgain = std::chrono::seconds(1);

}  // namespace

PeerState::PeerState(NodeState& node, std::string text)
    : node_(&node),
      text_(std::move(text)),
      link_(std::make_shared<Link>(node, node.poller(), node.options().limits, node.memory())) {
  static_cast<void>(link_->memory->open(true));
  link_->peer = this;
}

void PeerState::detach() { node_ = nullptr; }

bool PeerState::run(const std::function<void()>& task) {
  if (node_ == nullptr) return false;
  node_->run(task);
  return true;
}

void PeerState::start(Transport* transport, base::Result<Address> address) {
  if (!address) {
    set_problem(address.error());
    node_->journal().tell(rt::LogLevel::kError, "{}", address.error());
    return;
  }
  transport_ = transport;
  address_ = std::move(address).value();
  link_->scheme = address_.scheme;
  pause_ = node_->options().reconnection.first;
  connect(platform::monotonic_now());
}

void PeerState::connect(base::Time now) {
  connect_at_ = base::Time::max();
  auto connection = transport_->connect(address_);
  if (!connection) return try_later(now, connection.error());
  link_->incomplete_since = now;
  link_->begin(std::move(connection).value());
  node_->wake_at(base::later(now, node_->options().limits.time_to_complete));
}

void PeerState::try_later(base::Time now, const std::string& why) {
  const Reconnection& how = node_->options().reconnection;
  if (why != problem_) {
    node_->journal().tell(rt::LogLevel::kInfo, "{} cannot be reached: {}", text_, why);
  }
  set_problem(why);
  std::uniform_real_distribution<double> spread(1.0 - how.jitter, 1.0 + how.jitter);
  const auto part = [](base::Duration time, double factor) {
    return base::Duration(static_cast<std::int64_t>(static_cast<double>(time.count()) * factor));
  };
  connect_at_ = now + part(pause_, spread(node_->random()));
  pause_ = std::min(part(pause_, how.factor), how.most);
  node_->wake_at(connect_at_);
}

void PeerState::established() {
  ++generation_;
  up_ = true;
  heard_at_ = platform::monotonic_now();
  heard_ = link_->signs_of_life();
  asked_ = 0;
  ask_again_at_ = {};
  if (node_->options().reconnection.silence > base::Duration::zero()) {
    node_->wake_at(heard_at_ + node_->options().reconnection.silence);
  }
  link_->send_control(
      0, {Code::kHello, 0, 0, 0, node_->options().name + " armature/" ARMATURE_VERSION});
  open_questions_ = 1;
  for (const auto& component : components_) look_up(component);
  if (components_.empty()) ask_whether_it_is_there();
  answered();
}

/// That data can flow does not say that the other side takes any: with TLS it refuses after that.
void PeerState::ask_whether_it_is_there() {
  const std::tuple<std::string_view> nobody("");
  ask_the_directory(kFind, Fields(nobody), [](Code, std::string_view, auto) {});
}

/// Once all that was asked for has been answered, the peer is there.
void PeerState::answered() {
  if (--open_questions_ != 0 || !up_ || connected()) return;
  pause_ = node_->options().reconnection.first;
  {
    const std::lock_guard lock(mutex_);
    connected_.store(true, std::memory_order_release);
    problem_.clear();
  }
  changed_.notify_all();
  node_->journal().tell(rt::LogLevel::kInfo, "connected to {}", text_);
  tell({true, greeting_});
}

void PeerState::lost(const std::string& why) {
  const bool was_connected = connected();
  up_ = false;
  {
    const std::lock_guard lock(link_->mutex());
    for (const auto& component : components_) {
      component->identifier.store(0, std::memory_order_relaxed);
      component->state.store(RemoteComponent::State::kUnknown);
    }
  }
  for (auto& subscription : subscriptions_) subscription->sent = false;
  {
    const std::lock_guard lock(mutex_);
    connected_.store(false, std::memory_order_release);
  }
  changed_.notify_all();
  try_later(platform::monotonic_now(), why);
  if (!was_connected) return;
  losses_.fetch_add(1, std::memory_order_relaxed);
  node_->journal().tell(rt::LogLevel::kWarning, "lost {}: {}", text_, why);
  tell({false, why});
}

void PeerState::set_problem(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  problem_ = problem;
}

void PeerState::take_hello(std::string_view text) { greeting_ = text; }

base::Time PeerState::look_at_timers(base::Time now) {
  if (!up_) {
    if (now >= connect_at_) connect(now);
    return connect_at_;
  }
  if (now >= ask_at_) {
    ask_at_ = base::Time::max();
    for (const auto& component : components_) {
      if (component->state.load() == RemoteComponent::State::kMissing) look_up(component);
    }
  }
  return std::min(ask_at_, look_for_life(now));
}

/// It is lost only if it was asked and did not answer: after a pause of this process nobody knows
/// yet, and what it has sent meanwhile may wait to be read.
base::Time PeerState::look_for_life(base::Time now) {
  constexpr int kQuestions = 2;
  const base::Duration silence = node_->options().reconnection.silence;
  if (silence <= base::Duration::zero()) return base::Time::max();
  if (const std::uint64_t heard = link_->signs_of_life(); heard != heard_) {
    heard_ = heard;
    heard_at_ = now;
    asked_ = 0;
  }
  if (asked_ >= kQuestions && now - heard_at_ >= 3 * silence) {
    link_->break_off("it was silent for three times as long as allowed");
    return base::Time::max();
  }
  if (now - heard_at_ >= silence && now >= ask_again_at_) {
    ++asked_;
    ask_again_at_ = now + silence;
    link_->send_control(0, {Code::kPing, 0, 0, 0, {}});
  }
  return std::max(heard_at_ + silence, ask_again_at_);
}

/// The answer comes to whichever thread reads, and is handed to this one.
void PeerState::ask_the_directory(Number operation, const Fields& parameters,
                                  CallbackCall::Then then) {
  ++open_questions_;
  auto hand_over = [self = weak_from_this(), generation = generation_, then = std::move(then)](
                       Code code, std::string_view text, std::span<const std::byte> result) {
    const auto here = self.lock();
    if (here == nullptr || here->node_ == nullptr) return;
    here->node_->post([self, generation, then, code, text = std::string(text),
                       bytes = std::vector<std::byte>(result.begin(), result.end())] {
      const auto peer = self.lock();
      if (peer == nullptr || !peer->up_ || peer->generation_ != generation) return;
      then(code, text, bytes);
      peer->answered();
    });
  };
  constexpr Priority kMostUrgent{255};
  link_->call(operation, kMostUrgent, Recipient(kDirectory), parameters,
              std::make_unique<CallbackCall>(std::move(hand_over)));
}

void PeerState::look_up(const std::shared_ptr<RemoteComponent>& component) {
  const auto parameters = std::tie(component->name);
  ask_the_directory(
      kFind, Fields(parameters),
      [this, component](Code code, std::string_view text, std::span<const std::byte> result) {
        ComponentEntry entry;
        Decoder from(result);
        if (code == Code::kNone && from.take(entry) && from.ended()) {
          return found(component, entry);
        }
        node_->journal().tell(rt::LogLevel::kError, "{}: its directory does not answer: {} {}",
                              text_, name_of(code), text);
        set_state(*component, RemoteComponent::State::kMissing);
      });
}

void PeerState::found(const std::shared_ptr<RemoteComponent>& component,
                      const ComponentEntry& entry) {
  const Interface& expected = *component->interface;
  const bool right = entry.identifier != 0 && entry.interface == expected.name;
  if (entry.identifier == 0) {
    node_->journal().tell(rt::LogLevel::kWarning, "{} has no component '{}'", text_,
                          component->name);
  } else if (!right) {
    node_->journal().tell(rt::LogLevel::kError,
                          "'{}' at {} has the interface {}, but {} was expected", component->name,
                          text_, entry.interface, expected.name);
  } else if (entry.digest != digest(expected)) {
    node_->journal().tell(
        rt::LogLevel::kWarning,
        "'{}' at {} has another definition of {}: operations that differ are refused there",
        component->name, text_, expected.name);
  }
  {
    const std::lock_guard lock(link_->mutex());
    component->identifier.store(right ? static_cast<std::uint32_t>(entry.identifier) : 0);
  }
  const bool was_missing = component->state.load() == RemoteComponent::State::kMissing;
  set_state(*component, right ? RemoteComponent::State::kFound : RemoteComponent::State::kMissing);
  if (!right) return;
  for (const auto& subscription : subscriptions_) {
    if (subscription->component == component) send_subscription(*subscription);
  }
  if (was_missing && connected()) tell({true, greeting_});
}

/// Tells whoever waits for it; what is missing is looked for again.
void PeerState::set_state(RemoteComponent& component, RemoteComponent::State state) {
  {
    const std::lock_guard lock(mutex_);
    component.state.store(state);
  }
  changed_.notify_all();
  if (state != RemoteComponent::State::kMissing) return;
  ask_at_ = std::min(ask_at_, platform::monotonic_now() + kAskAgain);
  node_->wake_at(ask_at_);
}

}  // namespace armature::ride::internal
