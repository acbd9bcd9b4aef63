// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/node_state.hpp"

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::ride::internal {
namespace {

/// Without memory it goes on when others may have given some back.
constexpr base::Duration kShort = std::chrono::milliseconds(1);
constexpr const char* kGoodbye = "the node is shutting down";

thread_local const NodeState* node_of_this_thread = nullptr;

}  // namespace

NodeState::NodeState(NodeOptions options)
    : core_(std::move(options)),
      transports_(core_.options),
      access_(core_.options.allows),
      dispatcher_(core_, services_, access_),
      turns_(core_, dispatcher_),
      reception_(core_),
      links_(core_, *this, services_, reception_),
      peers_(core_, links_, reception_),
      flushes_(kFlushAge, [](Link& link, base::Time now) { return !link.flush(now, kFlushAge); }),
      returns_(kLending, [](Link& link, base::Time) { return link.take_back(); }),
      random_(static_cast<unsigned>(base::to_ns(platform::monotonic_now()))) {
  flushes_.reserve(Mailbox::kUsual);
  returns_.reserve(Mailbox::kUsual);
}

// ---- Its thread

void NodeState::start() {
  platform::ThreadRequest request;
  request.name = options().name;
  request.stack_bytes = 256 * 1024;
  request.prefault = false;  // A small server is to stay small.
  request.priority = options().serving.of({255});
  if (request.priority != 0) request.scheduler = platform::Scheduler::kFifo;
  thread_ = std::make_unique<platform::Thread>(request, [this] { run_loop(); });
  for (const std::string& refusal : thread_->grant().refusals) {
    core_.journal.tell(rt::LogLevel::kWarning, "the node's thread: {}", refusal);
  }
}

void NodeState::stop() {
  stopping_.store(true);
  core_.poller->wake();
  thread_.reset();
}

void NodeState::run_loop() {
  node_of_this_thread = this;
  core_.memory->set_keeper(std::this_thread::get_id());
  while (!stopping_.load(std::memory_order_relaxed)) {
    try {
      step(base::Duration::max());
    } catch (const std::bad_alloc&) {
      wait_for_memory();
    } catch (const std::system_error&) {  // no memory for another thread
      wait_for_memory();
    }
  }
  links_.stop_handshakes();
  say_goodbye();
  for (const auto& task : mailbox_.close()) task();
  core_.memory->set_keeper({});
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
  core_.poller->wake();
}

/// A round of the thread itself ends with a look into its mailbox.
void NodeState::wake() {
  if (!in_io_thread()) core_.poller->wake();
}

// ---- Its rounds

void NodeState::step(base::Duration limit) {
  if (std::exchange(was_short_, false)) {
    links_.look_after_all();
    peers_.look_after_all();
  }
  if (core_.memory->is_in_use()) {
    wake_at(base::later(core_.clock.now(), options().limits.time_to_complete / 4));
  }
  const bool has_to_do = !turns_.empty() || !mailbox_.empty() || reception_.has_to_read();
  if (has_to_do || core_.memory->release_scrap()) limit = {};
  const auto ready = core_.poller->wait(std::min(limit, time_left()));
  ++rounds_;  // Another one is first in each round.
  for (std::size_t i = 0; i < ready.size(); ++i) {
    links_.take_ready(ready[(rounds_ + i) % ready.size()]);
  }
  links_.take_handshakes();
  if (!mailbox_.empty()) take_letters();
  turns_.take(links_.size() < 2);
  reception_.read_next();
  if (core_.poller->time_has_come() || !flushes_.is_empty()) look_at_clock();
  links_.forget_departed();
}

/// The poller is told of times that are far away: they are asked for seldom, it waits often.
base::Duration NodeState::time_left() {
  core_.poller->wake_at(std::min(core_.clock.due(), returns_.due()));
  if (flushes_.is_empty()) return base::Duration::max();
  return flushes_.due() - platform::monotonic_now();
}

void NodeState::look_at_clock() {
  const base::Time now = core_.clock.look();
  flushes_.make_if_due(now);
  returns_.make_if_due(now);
  if (!core_.clock.take_due()) return;
  turns_.look_at_timers();
  links_.look_at_timers();
  peers_.look_at_timers();
}

void NodeState::take_handed_over() {
  mailbox_.take_messages(
      [this](Link& link, const Message& message) { turns_.push(link, message); });
}

void NodeState::take_letters() {
  const base::Time now = core_.clock.look();
  take_handed_over();
  Mailbox::Letters& letters = mailbox_.open();
  for (auto& link : letters.flushes) flushes_.add(std::move(link), now);
  for (auto& link : letters.returns) returns_.add(std::move(link), now);
  for (const auto& link : letters.attention) links_.look_after(*link);
  for (const auto& task : letters.tasks) task();
  letters.flushes.clear();
  letters.returns.clear();
  letters.attention.clear();
  letters.tasks.clear();
}

void NodeState::say_goodbye() {
  turns_.refuse_all(kGoodbye);
  links_.leave_all(kGoodbye);
  peers_.leave_all(kGoodbye);
  services_.unsubscribe_all();
  links_.close_all();
  peers_.close_all(kGoodbye);
  links_.forget_all();
}

// ---- What links tell it

void NodeState::count(std::uint64_t messages) {
  Counters::increase(core_.counters.messages, messages);
}

void NodeState::deliver(Link& link, const Message& message) {
  // A handler that calls receives for the node like any other caller: the message that it handles
  // has to stay where it lies.
  if (in_io_thread() && !turns_.dispatches()) {
    // What a caller has received before comes first.
    if (mailbox_.has_messages()) take_handed_over();
    return turns_.push(link, message);
  }
  const bool fits = mailbox_.hand_over(link, message);
  wake();
  if (fits) return;
  Counters::increase(core_.counters.events_dropped);
  journal().tell(rt::LogLevel::kWarning, "messages were dropped: the node's thread is too slow");
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

void NodeState::refused(const Link& link, Code code, const Message& message,
                        std::string_view text) {
  Counters::increase(core_.counters.refusals);
  journal().tell(rt::LogLevel::kWarning, "{} was refused a {}: {} ({})", link.end_locked(),
                 name_of(message.header.type), name_of(code), text);
}

std::optional<Refusal> NodeState::refusal_of(const Link& link, const Message& first,
                                             const std::string& identity) {
  return dispatcher_.refusal_of(link, first, identity);
}

void NodeState::event_dropped(const EventQueue& queue) {
  Counters::increase(core_.counters.events_dropped);
  journal().tell(rt::LogLevel::kWarning,
                 "an event of component {} was dropped: its subscriber {} is too slow",
                 queue.component, queue.subscription);
}

// ---- What its owner tells it

base::Result<Address> NodeState::listen(const std::string& text) {
  const auto place = transports_.place_to_listen(text);
  if (!place) return base::Error{place.error()};
  base::Result<Address> got = base::Error{};
  run([&] {
    auto listener = place.value().transport->listen(place.value().address);
    if (listener) {
      got = links_.listen(std::move(listener).value());
    } else {
      got = base::Error{listener.error()};
    }
  });
  if (got && !options().allows) warn_of_everyone(got.value());
  return got;
}

/// What a newcomer does not expect.
void NodeState::warn_of_everyone(const Address& address) {
  constexpr unsigned kOthers = 0022;
  if (address.scheme == "unix" && (options().socket_mode & kOthers) == 0) return;
  constexpr const char* kWarning =
      "everyone on this machine may do everything at {}: the node has no policy (set "
      "NodeOptions::allows)";
  journal().tell(rt::LogLevel::kWarning, kWarning, address.text());
  if (options().log) return;
  std::fprintf(stderr,
               "ride: everyone on this machine may do everything at %s: the node has no policy "
               "(set NodeOptions::allows)\n",
               address.text().c_str());
}

base::Result<std::uint32_t> NodeState::add(std::string name, Service& service) {
  base::Result<std::uint32_t> identifier = base::Error{};
  run([&] { identifier = services_.add(options().name, std::move(name), service); });
  return identifier;
}

void NodeState::remove(Service& service) {
  run([&] {
    const std::uint32_t identifier = services_.remove(service);
    if (identifier != 0) links_.end_events_of(identifier);
  });
}

Peer& NodeState::connect(const std::string& text) {
  const auto place = transports_.place_of(text);
  Transport* const transport = place ? place.value().transport : nullptr;
  const auto address = place ? transport->look_up(place.value().address)
                             : base::Result<Address>(base::Error{place.error()});
  Peer* peer = nullptr;
  run([&] {
    peer = peers_.find(text);
    if (peer == nullptr) peer = &peers_.add(*this, text, transport, address);
  });
  return *peer;
}

NodeStatistics NodeState::statistics() const {
  return core_.counters.statistics(core_.memory->used());
}

}  // namespace armature::ride::internal
