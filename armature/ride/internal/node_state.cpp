// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node_state.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <stdexcept>
#include <utility>

#include "armature/platform/clock.hpp"
#include "armature/ride/internal/peer_state.hpp"
#include "armature/ride/internal/publisher.hpp"

namespace armature::ride::internal {
namespace {

/// Messages that arrive while others are dispatched wait no longer for their turn.
constexpr base::Duration kRound = std::chrono::microseconds(20);
/// Who has sent so many messages at once, or bytes, sends much.
constexpr std::uint64_t kManyMessages = 64;
constexpr std::size_t kManyBytes = 4 * 1024;
/// Without descriptors or memory a connection would be refused again and again.
constexpr base::Duration kNoDescriptors = std::chrono::milliseconds(100);

thread_local const NodeState* node_of_this_thread = nullptr;

}  // namespace

NodeState::NodeState(NodeOptions options)
    : options_(std::move(options)),
      journal_(options_.name, options_.log),
      transports_(options_.transports),
      random_(static_cast<unsigned>(base::to_ns(platform::monotonic_now()))),
      handshakes_(
          options_.name,
          [this](Link& link, Progress progress) {
            link.shakes_hands = false;
            if (link.come_back(progress)) is_up(link);
          },
          [this] { poller_->wake(); }) {
  transports_.push_back(make_tcp_transport());
  transports_.push_back(make_unix_transport());
  auto poller = platform::Poller::make();
  if (!poller) throw std::runtime_error("node '" + options_.name + "': " + poller.error());
  poller_ = std::move(poller).value();
  flushed_.reserve(Letters::kUsual);
  lent_.reserve(Letters::kUsual);
}

NodeState::~NodeState() {
  for (const auto& peer : peers_) peer->state()->detach();
}

Transport* NodeState::find_transport(const std::string& scheme) {
  const auto found = std::ranges::find_if(
      transports_, [&](const auto& transport) { return transport->scheme() == scheme; });
  return found == transports_.end() ? nullptr : found->get();
}

void NodeState::start() {
  platform::ThreadRequest request;
  request.name = options_.name;
  request.stack_bytes = 256 * 1024;
  request.prefault = false;  // A small server is to stay small.
  thread_ = std::make_unique<platform::Thread>(request, [this] { run_loop(); });
}

void NodeState::stop() {
  stopping_.store(true);
  poller_->wake();
  thread_.reset();
}

void NodeState::run_loop() {
  node_of_this_thread = this;
  while (!stopping_.load(std::memory_order_relaxed)) step(base::Duration::max());
  handshakes_.stop();
  say_goodbye();
  Letters last;
  {
    const std::lock_guard lock(letters_mutex_);
    stopped_ = true;
    std::swap(last.tasks, letters_.tasks);
  }
  for (const auto& task : last.tasks) task();
  node_of_this_thread = nullptr;
}

bool NodeState::in_io_thread() const { return node_of_this_thread == this; }

void NodeState::run(const std::function<void()>& task) {
  if (in_io_thread()) return task();
  std::mutex mutex;
  std::condition_variable done;
  bool is_done = false;
  post([&] {
    task();
    const std::lock_guard lock(mutex);
    is_done = true;
    done.notify_one();
  });
  std::unique_lock lock(mutex);
  done.wait(lock, [&] { return is_done; });
}

void NodeState::post(std::function<void()> task) {
  {
    const std::lock_guard lock(letters_mutex_);
    if (!stopped_) {
      letters_.tasks.push_back(std::move(task));
      has_letters_.store(true);
    }
  }
  if (task) return task();  // The thread is no more.
  poller_->wake();
}

template <typename Write>
void NodeState::leave_letter(const Write& write) {
  {
    const std::lock_guard lock(letters_mutex_);
    write(letters_);
    has_letters_.store(true);
  }
  if (!in_io_thread()) poller_->wake();
}

void NodeState::count(std::uint64_t messages) {
  counters_.messages.fetch_add(messages, std::memory_order_relaxed);
}

void NodeState::deliver(Link& link, const Message& message) {
  if (in_io_thread()) {
    // What a caller has received before comes first.
    if (has_handed_over_.load(std::memory_order_acquire)) take_handed_over();
    return pending_.push(link.waiting, message);
  }
  bool full = false;
  leave_letter([&](Letters& letters) {
    full = letters.messages.full();
    if (!full) letters.messages.push(link, message);
    has_handed_over_.store(true, std::memory_order_release);
  });
  if (!full) return;
  counters_.events_dropped.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "messages were dropped: the node's thread is too slow");
}

void NodeState::take_handed_over() {
  const std::lock_guard lock(letters_mutex_);
  has_handed_over_.store(false);
  letters_.messages.take_all(
      [this](Link& link, const Message& message) { pending_.push(link.waiting, message); });
}

void NodeState::attend(Link& link) {
  leave_letter([&](Letters& letters) { letters.attention.push_back(link.shared_from_this()); });
}

void NodeState::flush_soon(Link& link) {
  leave_letter([&](Letters& letters) { letters.flushes.push_back(link.shared_from_this()); });
}

void NodeState::return_soon(Link& link) {
  leave_letter([&](Letters& letters) { letters.returns.push_back(link.shared_from_this()); });
}

void NodeState::event_dropped(const EventQueue& queue) {
  counters_.events_dropped.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning,
                "an event of component {} was dropped: its subscriber {} is too slow",
                queue.component, queue.subscription);
}

void NodeState::step(base::Duration limit) {
  if (!pending_.empty() || has_letters_.load()) limit = {};
  const auto ready = poller_->wait(std::min(limit, time_left()));
  ++rounds_;  // Another one is first in each round.
  for (std::size_t i = 0; i < ready.size(); ++i) take_ready(ready[(rounds_ + i) % ready.size()]);
  handshakes_.take_done();
  if (has_letters_.load(std::memory_order_acquire)) take_letters();
  dispatch_pending();
  if (Link* const link = std::exchange(sends_much_, nullptr)) {
    receive(*link);
    link->look_again();
  }
  if (poller_->time_has_come() || flush_at_ != base::Time::max()) look_at_clock();
  forget_departed();
}

/// Listeners are known by their place, links by where they are.
void NodeState::take_ready(const platform::Ready& ready) {
  const auto key = static_cast<std::uintptr_t>(ready.key);
  if (key < listeners_.size()) return accept(*listeners_[key]);
  service_link(*reinterpret_cast<Link*>(key), ready);
}

void NodeState::accept(Listener& listener) {
  now_ = platform::monotonic_now();
  auto connection = listener.accept();
  if (!connection) return pause_accepting(now_ + kNoDescriptors);
  space_connections();
  if (links_.size() >= options_.limits.connections && !make_room()) {
    counters_.connections_refused.fetch_add(1, std::memory_order_relaxed);
    return journal_.tell(rt::LogLevel::kWarning,
                         "{} was sent away: there are {} connections, as many as may be",
                         connection->other_end(), links_.size());
  }
  adopt(std::move(connection), listener.address().scheme);
}

/// To come and go costs the node more than its messages do.
void NodeState::space_connections() {
  constexpr base::Duration kSecond = std::chrono::seconds(1);
  connection_due_ = std::max(connection_due_, now_) +
                    kSecond / std::max(options_.limits.connections_per_second, 1u);
  const base::Time from = connection_due_ - kSecond / 10;
  if (from > now_) pause_accepting(from);
}

void NodeState::pause_accepting(base::Time until) {
  for (std::size_t k = 0; k < listeners_.size(); ++k) {
    poller_->change(listeners_[k]->handle(), k, {});
  }
  accept_from_ = until;
  wake_at(until);
}

std::shared_ptr<Link> NodeState::adopt(std::unique_ptr<Connection> connection,
                                       const std::string& scheme) {
  links_.push_back(std::make_shared<Link>(*this, *poller_, options_.limits));
  const auto link = links_.back();
  link->scheme = scheme;
  link->incomplete_since = now_;
  link->begin(std::move(connection));
  counters_.connections.store(links_.size(), std::memory_order_relaxed);
  service_link(*link, {});
  if (!link->established) wake_at(base::later(now_, options_.limits.time_to_complete));
  return link;
}

void NodeState::bring_up(Link& link) {
  if (link.shakes_hands) return;
  link.shakes_hands = link.hold();
  if (link.shakes_hands) return handshakes_.add(link.shared_from_this());
  if (link.establish()) is_up(link);
}

/// Data can flow.
void NodeState::is_up(Link& link) {
  link.established = true;
  link.incomplete_since = base::Time::max();
  if (link.peer != nullptr) link.peer->established();
}

void NodeState::service_link(Link& link, const platform::Ready& ready) {
  if (!link.established) return bring_up(link);
  const bool can_go_on_reading = ready.write && link.write();
  if (!ready.read && !can_go_on_reading) return;
  if (!link.waiting.empty()) return link.look_again();  // its turn comes when those are done
  if (link.sends_much) {
    if (Link* const other = std::exchange(sends_much_, &link)) other->look_again();
    return;
  }
  receive(link);
  if (ready.ended) link.look_again();  // after what came last the end is to be seen
}

/// Asks what time it is only where that matters.
void NodeState::receive(Link& link) {
  const std::uint64_t before = link.received();
  std::size_t size = 0;
  const auto incomplete = link.read(size);
  if (!incomplete) {
    link.incomplete_since = base::Time::max();
  } else if (link.incomplete_since == base::Time::max() || *incomplete != link.incomplete_message) {
    link.incomplete_message = *incomplete;
    link.incomplete_since = platform::monotonic_now();
    wake_at(base::later(link.incomplete_since, options_.limits.time_to_complete));
  }
  const std::uint64_t count = link.received() - before;
  link.sends_much = count >= kManyMessages || size >= kManyBytes;
  link.window_messages += count;
  if (link.window_messages > options_.limits.messages_per_second) throttle(link);
}

void NodeState::take_letters() {
  now_ = platform::monotonic_now();
  take_handed_over();
  {
    const std::lock_guard lock(letters_mutex_);
    has_letters_.store(false);
    opened_.swap(letters_);
  }
  for (auto& link : opened_.flushes) {
    flushed_.push_back(std::move(link));
    flush_at_ = std::min(flush_at_, now_ + kFlushAge);
  }
  for (auto& link : opened_.returns) {
    lent_.push_back(std::move(link));
    return_at_ = std::min(return_at_, now_ + kLending);
  }
  for (const auto& link : opened_.attention) look_after(*link);
  for (const auto& task : opened_.tasks) task();
  opened_.flushes.clear();
  opened_.returns.clear();
  opened_.attention.clear();
  opened_.tasks.clear();
}

void NodeState::dispatch_pending() {
  constexpr int kBetweenLooks = 2;
  base::Time end{};
  for (int i = 1; !pending_.empty(); ++i) {
    const Pending::Entry entry = pending_.pop();
    const bool is_large = entry.message.body.size() >= kManyBytes;
    dispatch(*entry.link, entry.message);
    if (i % kBetweenLooks != 0 && !is_large) continue;
    const base::Time now = platform::monotonic_now();
    if (end == base::Time{}) end = now + kRound;
    if (now >= end) return;
  }
}

/// A connection has ended.
void NodeState::look_after(Link& link) {
  if (!link.ended() || link.shakes_hands) return;  // Then it is attended to when it comes back.
  const std::string why = link.problem();
  const std::string who = link.other_end();
  const bool was_established = link.established;
  for (Hosted& hosted : hosted_) {
    if (hosted.service != nullptr) ServiceAccess::publisher(*hosted.service).remove(link);
  }
  if (!link.close()) return;  // The thread that still has it comes back with it.
  if (link.peer != nullptr) return link.peer->lost(why);
  tell_end(who, was_established, why);
  end(link);
}

void NodeState::end(Link& link) {
  const auto at = std::ranges::find(links_, &link, &std::shared_ptr<Link>::get);
  if (at == links_.end()) return;
  departed_.push_back(std::move(*at));
  links_.erase(at);
  counters_.connections.store(links_.size(), std::memory_order_relaxed);
}

void NodeState::forget_departed() {
  std::erase_if(departed_, [](const auto& link) { return link->waiting.empty(); });
}

void NodeState::say_goodbye() {
  while (!pending_.empty()) {
    const Pending::Entry entry = pending_.pop();
    entry.link->refuse(Code::kShuttingDown, entry.message, "the node shuts down");
  }
  const auto leave = [](Link& link) {
    link.send_control(0, {Code::kShuttingDown, 0, 0, 0, "the node shuts down"});
    link.break_off("the node shuts down");
  };
  for (const auto& link : links_) leave(*link);
  for (const auto& peer : peers_) leave(peer->state()->link());
  for (Hosted& hosted : hosted_) {
    if (hosted.service != nullptr) ServiceAccess::publisher(*hosted.service).remove_all();
  }
  for (const auto& link : links_) link->close();
  for (const auto& peer : peers_) {
    // Whoever still reads has been told, and is on its way.
    while (!peer->state()->link().close())
      platform::sleep_until(platform::monotonic_now() + kRound);
    peer->state()->lost("the node shuts down");
  }
  links_.clear();
  departed_.clear();
  listeners_.clear();
}

}  // namespace armature::ride::internal
