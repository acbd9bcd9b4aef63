// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node_state.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
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
/// What takes longer is followed by a pause of so many times as long, in which no other such
/// message is executed.
constexpr base::Duration kLongTurn = std::chrono::microseconds(200);
constexpr int kPauseFactor = 20;
constexpr base::Duration kLongestPause = std::chrono::milliseconds(100);
/// Without memory it goes on when others may have given some back.
constexpr base::Duration kShort = std::chrono::milliseconds(1);

thread_local const NodeState* node_of_this_thread = nullptr;

std::unique_ptr<platform::Poller> make_poller(const std::string& node) {
  auto poller = platform::Poller::make();
  if (!poller) throw std::runtime_error("node '" + node + "': " + poller.error());
  return std::move(poller).value();
}

}  // namespace

NodeState::NodeState(NodeOptions options)
    : options_(std::move(options)),
      memory_(std::make_shared<MemoryBound>(options_.limits.memory_bytes,
                                            options_.limits.connections * Link::kReserve)),
      journal_(options_.name, options_.log),
      transports_(options_.transports),
      poller_(make_poller(options_.name)),
      random_(static_cast<unsigned>(base::to_ns(platform::monotonic_now()))),
      entrance_(*poller_, options_.limits.connections_per_second),
      handshakes_(
          options_.name,
          [this](Link& link, Progress progress) {
            link.shakes_hands = false;
            if (link.come_back(progress)) is_up(link);
          },
          [this] { poller_->wake(); }) {
  transports_.push_back(make_tcp_transport());
  transports_.push_back(make_unix_transport(options_.socket_mode));
  flushed_.reserve(Mailbox::kUsual);
  lent_.reserve(Mailbox::kUsual);
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
  memory_->set_keeper(std::this_thread::get_id());
  while (!stopping_.load(std::memory_order_relaxed)) {
    try {
      step(base::Duration::max());
    } catch (const std::bad_alloc&) {
      wait_for_memory();
    } catch (const std::system_error&) {  // no memory for another thread
      wait_for_memory();
    }
  }
  handshakes_.stop();
  say_goodbye();
  for (const auto& task : mailbox_.close()) task();
  memory_->set_keeper({});
  node_of_this_thread = nullptr;
}

void NodeState::wait_for_memory() {
  was_short_ = true;
  platform::sleep_until(platform::monotonic_now() + kShort);
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
  if (!mailbox_.post(task)) return task();  // The thread is no more.
  poller_->wake();
}

/// A round of the thread itself ends with a look into its mailbox.
void NodeState::wake() {
  if (!in_io_thread()) poller_->wake();
}

void NodeState::count(std::uint64_t messages) {
  counters_.messages.fetch_add(messages, std::memory_order_relaxed);
}

void NodeState::deliver(Link& link, const Message& message) {
  // A handler that calls receives for the node like any other caller: the message that it handles
  // has to stay where it lies.
  if (in_io_thread() && !dispatches_) {
    // What a caller has received before comes first.
    if (mailbox_.has_messages()) take_handed_over();
    return pending_.push(link.waiting, message);
  }
  const bool fits = mailbox_.hand_over(link, message);
  wake();
  if (fits) return;
  counters_.events_dropped.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning, "messages were dropped: the node's thread is too slow");
}

void NodeState::take_handed_over() {
  mailbox_.take_messages(
      [this](Link& link, const Message& message) { pending_.push(link.waiting, message); });
}

void NodeState::attend(Link& link) {
  mailbox_.attend(link.shared_from_this());
  wake();
}

void NodeState::flush_soon(Link& link) {
  mailbox_.flush(link.shared_from_this());
  wake();
}

void NodeState::return_soon(Link& link) {
  mailbox_.take_back(link.shared_from_this());
  wake();
}

void NodeState::event_dropped(const EventQueue& queue) {
  counters_.events_dropped.fetch_add(1, std::memory_order_relaxed);
  journal_.tell(rt::LogLevel::kWarning,
                "an event of component {} was dropped: its subscriber {} is too slow",
                queue.component, queue.subscription);
}

void NodeState::step(base::Duration limit) {
  if (std::exchange(was_short_, false)) look_after_all();
  if (memory_->is_in_use()) wake_at(base::later(now_, options_.limits.time_to_complete / 4));
  const bool has_to_do = !pending_.empty() || !mailbox_.empty() || !greedy_.empty();
  if (has_to_do || memory_->release_scrap()) limit = {};
  const auto ready = poller_->wait(std::min(limit, time_left()));
  ++rounds_;  // Another one is first in each round.
  for (std::size_t i = 0; i < ready.size(); ++i) take_ready(ready[(rounds_ + i) % ready.size()]);
  handshakes_.take_done();
  if (!mailbox_.empty()) take_letters();
  dispatch_pending();
  receive_of_greedy();
  if (poller_->time_has_come() || flush_at_ != base::Time::max()) look_at_clock();
  forget_departed();
}

/// Listeners are known by their place, links by where they are.
void NodeState::take_ready(const platform::Ready& ready) {
  const auto key = static_cast<std::uintptr_t>(ready.key);
  if (Listener* const listener = entrance_.find(key)) return accept(*listener);
  service_link(*reinterpret_cast<Link*>(key), ready);
}

void NodeState::service_link(Link& link, const platform::Ready& ready) {
  if (!link.established) return bring_up(link);
  if (ready.ended && link.is_leaving()) return link.break_off("the other side has ended it");
  const bool can_go_on_reading = ready.write && link.write();
  if (link.is_leaving()) return let_go(link);
  if (!ready.read && !can_go_on_reading) return;
  if (!link.waiting.empty()) return link.look_again();  // its turn comes when those are done
  if (link.sends_much) return wait_for_turn(link);
  receive(link);
  if (ready.ended) link.look_again();  // after what came last the end is to be seen
}

void NodeState::wait_for_turn(Link& link) {
  if (!std::exchange(link.waits_for_turn, true)) greedy_.push_back(&link);
}

/// Of those who send much one is read in a round, last of all: what others have sent does not wait
/// until all their floods have been read.
void NodeState::receive_of_greedy() {
  if (greedy_.empty()) return;
  Link& link = *greedy_.front();
  greedy_.pop_front();
  link.waits_for_turn = false;
  receive(link);
  link.look_again();
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
  if (link.is_leaving()) let_go(link);
  link.sends_much = count >= kManyMessages || size >= kManyBytes;
  link.window_messages += count;
  if (link.window_messages > options_.limits.messages_per_second) throttle(link);
}

void NodeState::take_letters() {
  now_ = platform::monotonic_now();
  take_handed_over();
  Mailbox::Letters& letters = mailbox_.open();
  for (auto& link : letters.flushes) {
    flushed_.push_back(std::move(link));
    flush_at_ = std::min(flush_at_, now_ + kFlushAge);
  }
  for (auto& link : letters.returns) {
    lent_.push_back(std::move(link));
    return_at_ = std::min(return_at_, now_ + kLending);
  }
  for (const auto& link : letters.attention) look_after(*link);
  for (const auto& task : letters.tasks) task();
  letters.flushes.clear();
  letters.returns.clear();
  letters.attention.clear();
  letters.tasks.clear();
}

void NodeState::dispatch_pending() {
  constexpr int kBetweenLooks = 2;
  base::Time end{};
  for (int i = 1; !pending_.empty(); ++i) {
    const Pending::Entry entry = pending_.pop();
    const bool is_large = entry.message.body.size() >= kManyBytes;
    if (entry.link->waiting.has_large()) {
      dispatch_large(*entry.link, entry.message);
    } else {
      dispatch_safely(*entry.link, entry.message);
    }
    entry.link->waiting.settle();
    let_go(*entry.link);
    if (i % kBetweenLooks != 0 && !is_large) continue;
    const base::Time now = platform::monotonic_now();
    if (end == base::Time{}) end = now + kRound;
    if (now >= end) return;
  }
}

/// While one that takes long is executed all others wait: after it there is time for them, before
/// the next one of whomever.
void NodeState::dispatch_large(Link& link, const Message& message) {
  const base::Time before = platform::monotonic_now();
  dispatch_safely(link, message);
  now_ = platform::monotonic_now();
  const base::Duration took = now_ - before;
  if (took < kLongTurn || links_.size() < 2) return;
  large_from_ = now_ + std::min(kPauseFactor * took, kLongestPause);
  pending_.hold_large();
  wake_at(large_from_);
}

void NodeState::dispatch_safely(Link& link, const Message& message) {
  dispatches_ = true;
  try {
    dispatch(link, message);
  } catch (const std::bad_alloc&) {
    link.refuse(Code::kBusy, message, "not enough memory for it");
  }
  dispatches_ = false;
}

void NodeState::say_goodbye() {
  pending_.release_large();
  while (!pending_.empty()) {
    const Pending::Entry entry = pending_.pop();
    entry.link->refuse(Code::kShuttingDown, entry.message, "the node is shutting down");
  }
  const auto leave = [](Link& link) {
    link.send_control(0, {Code::kShuttingDown, 0, 0, 0, "the node is shutting down"});
    link.break_off("the node is shutting down");
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
    peer->state()->lost("the node is shutting down");
  }
  links_.clear();
  departed_.clear();
  entrance_.close();
}

}  // namespace armature::ride::internal
