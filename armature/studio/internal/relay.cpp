// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/relay.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "armature/foxglove/server.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/inspector.hpp"
#include "inspection_types.hpp"

namespace armature::studio::internal {

/// A body as it is.
struct Encoded {
  std::span<const std::byte> body;
};

void encode(ride::Encoder& to, const Encoded& encoded) { to.put_body(encoded.body); }

namespace {

/// `write` of `struct ItemValue write(String,String)`.
std::string_view name_in(std::string_view canonical) {
  const std::string_view before = canonical.substr(0, canonical.find('('));
  return before.substr(before.find_last_of(' ') + 1);
}

bool is_foxglove(const ride::Origin& origin) {
  return origin.who() == std::string(foxglove::kIdentity) + "@web";
}

/// What whoever asks may do to the component that it asks about, as the inspector demands it: that
/// anybody may ask is all that its interface says.
ride::Access access_of(const ride::Declaration& declaration) {
  const std::string_view name = name_in(declaration.canonical);
  for (const std::string_view changes : {"write", "change"}) {
    if (name == changes) return ride::Access::kConfigure;
  }
  for (const std::string_view commands : {"call", "begin", "cancel"}) {
    if (name == commands) return ride::Access::kCommand;
  }
  return declaration.access;
}

/// Of an operation of the inspector.
ride::Access access_named(std::string_view name) {
  const auto& all = remote::kInspector.declarations;
  const auto found = std::ranges::find(
      all, name, [](const ride::Declaration& one) { return name_in(one.canonical); });
  return access_of(*found);
}

/// The number of an operation of the inspector.
ride::Number number_of(std::string_view name) {
  const auto& all = remote::kInspector.declarations;
  const auto found = std::ranges::find(
      all, name, [](const ride::Declaration& one) { return name_in(one.canonical); });
  return found->number();
}

/// So many descriptions, or states of commands, are asked for at once.
constexpr std::size_t kAtOnce = 8;
constexpr std::tuple<> kNothing;
constexpr ride::Priority kUrgent{255};

/// What decodes a result for `told`, or has it told why there is none.
template <typename T>
auto decoded(WatchedRun::Told<T> told) {
  return [told = std::move(told)](ride::Code code, std::string_view text,
                                  std::span<const std::byte> result) {
    T value;
    if (code != ride::Code::kNone) return told(base::Error{std::string(text)});
    if (!ride::Decoder(result).take(value))
      return told(base::Error{"the run's answer is malformed"});
    told(std::move(value));
  };
}

}  // namespace

Relay::Connection::Connection(std::unique_ptr<ride::Node> own_node, ride::Peer& peer,
                              const std::function<void()>& wake)
    : watches(std::make_shared<WatchUnion>(wake, platform::monotonic_now)),
      node(std::move(own_node)),
      inspector(peer, remote::Inspector::kName, remote::kInspector) {}

void Relay::Connection::watch(const std::vector<std::string>& items, double interval,
                              Told<remote::Watch> told) {
  inspector.ask(number_of("watch"), {}, ride::Fields(std::tie(items, interval)),
                decoded<remote::Watch>(std::move(told)));
}

void Relay::Connection::watched(std::int32_t handle, Told<remote::WatchedValues> told) {
  inspector.ask(number_of("watched"), {}, ride::Fields(std::tie(handle)),
                decoded<remote::WatchedValues>(std::move(told)));
}

void Relay::Connection::end_watch(std::int32_t handle) {
  inspector.ask(number_of("end_watch"), {}, ride::Fields(std::tie(handle)),
                [](ride::Code, std::string_view, std::span<const std::byte>) {});
}

Relay::Relay(std::string name, Seat& seat, std::function<void()> wake)
    : Service(remote::kInspector), name_(std::move(name)), seat_(seat), wake_(std::move(wake)) {}

void Relay::connect(const std::string& address) {
  auto node = std::make_unique<ride::Node>();
  ride::Peer& peer = node->connect(address);
  take(std::make_shared<Connection>(std::move(node), peer, wake_));
}

void Relay::connect(ride::Peer& peer) { take(std::make_shared<Connection>(nullptr, peer, wake_)); }

/// The one before ends without the lock.
void Relay::take(std::shared_ptr<Connection> made) {
  const std::scoped_lock lock(mutex_);
  connection_.swap(made);
}

void Relay::disconnect() {
  std::shared_ptr<Connection> gone;
  const std::scoped_lock lock(mutex_);
  connection_.swap(gone);
}

std::shared_ptr<Relay::Connection> Relay::connection() const {
  const std::scoped_lock lock(mutex_);
  return connection_;
}

// --- what is known of a run ----------------------------------------------------------------------

bool Relay::ready() const { return to_disarm().has_value(); }

std::optional<std::vector<std::string>> Relay::to_disarm() const {
  const auto run = connection();
  if (run == nullptr || !run->inspector.found()) return std::nullopt;
  const std::scoped_lock lock(run->learned->mutex);
  if (!run->learned->acts.complete()) return std::nullopt;
  return run->learned->acts.disarmed();
}

void Relay::learn() {
  const auto run = connection();
  if (run == nullptr || !run->inspector.found()) return;
  run->watches->advance(*run);
  std::vector<std::string> missing;
  {
    const std::scoped_lock lock(run->learned->mutex);
    if (run->learned->acts.complete() || run->learned->asked > 0) return;
    missing = run->learned->acts.missing();
  }
  if (missing.empty()) {
    ask_for(*run, wake_, "components", ride::Fields(kNothing), [](auto& from, auto& acts) {
      std::vector<remote::ComponentStatus> components;
      const bool told = from.take(components);
      if (told) acts.expect(components);
      return told;
    });
  }
  for (std::size_t i = 0; i < std::min(missing.size(), kAtOnce); ++i) {
    ask_for(*run, wake_, "describe", ride::Fields(std::tie(missing[i])),
            [](auto& from, auto& acts) {
              remote::ComponentDetails details;
              const bool told = from.take(details);
              if (told) acts.add(details);
              return told;
            });
  }
}

/// What a run does not tell is asked for again.
void Relay::ask_for(Connection& run, const std::function<void()>& wake, std::string_view operation,
                    const ride::Fields& parameters,
                    std::function<bool(ride::Decoder&, OperatorsActs&)> take) {
  {
    const std::scoped_lock lock(run.learned->mutex);
    ++run.learned->asked;
  }
  const auto told = [learned = run.learned, wake, take = std::move(take)](
                        ride::Code code, std::string_view, std::span<const std::byte> result) {
    const std::scoped_lock lock(learned->mutex);
    --learned->asked;
    ride::Decoder from(result);
    if (code == ride::Code::kNone && take(from, learned->acts)) wake();
  };
  run.inspector.ask(number_of(operation), {}, parameters, told);
}

void Relay::cancel_lost(base::Time now) {
  const auto run = connection();
  if (run == nullptr || !run->inspector.found()) return;
  const auto learned = run->learned;
  run->watches->end_lost();
  for (const std::int32_t handle : learned->begun.lost(now)) {
    ask_about(*run, "cancel", handle, kUrgent, [learned, handle](const auto& status) {
      if (status) learned->begun.end(handle);
    });
  }
  if (learned->followed > 0) return;
  for (const std::int32_t handle : learned->begun.next(kAtOnce)) {
    ++learned->followed;
    ask_about(*run, "follow", handle, {}, [learned, handle](const auto& status) {
      --learned->followed;
      if (status && status->ended) learned->begun.end(handle);
    });
  }
}

/// @param told  what has become of it, unless the run did not say
void Relay::ask_about(Connection& run, std::string_view operation, std::int32_t handle,
                      ride::Priority priority,
                      std::function<void(const std::optional<remote::CommandStatus>&)> told) {
  run.inspector.ask(number_of(operation), priority, ride::Fields(std::tie(handle)),
                    [told = std::move(told)](ride::Code code, std::string_view,
                                             std::span<const std::byte> result) {
                      remote::CommandStatus status;
                      const bool known =
                          code == ride::Code::kNone && ride::Decoder(result).take(status);
                      told(known ? std::optional(status) : std::nullopt);
                    });
}

/// What a run has answered to `begin`.
void Relay::take_begun(Learned& learned, std::span<const std::byte> result,
                       const ride::Origin& origin) {
  remote::CommandStatus status;
  if (ride::Decoder(result).take(status) && !status.ended) {
    learned.begun.add(status.handle, origin);
  }
}

void Relay::disarm(const std::string& component, Done done) {
  const auto run = connection();
  if (run == nullptr) return done(base::Error{"nothing runs"});
  const std::string operation = "disarm";
  const std::vector<std::string> no_arguments;
  const auto told = [done = std::move(done)](ride::Code code, std::string_view text,
                                             std::span<const std::byte>) {
    done(code == ride::Code::kNone ? base::Result<void>() : base::Error{std::string(text)});
  };
  run->inspector.ask(number_of("call"), kUrgent,
                     ride::Fields(std::tie(component, operation, no_arguments)), told);
}

// --- what is handed on ---------------------------------------------------------------------------

ride::Executed Relay::execute(ride::Number operation, ride::Decoder& parameters,
                              ride::Reply& reply) {
  const auto& all = interface().declarations;
  const auto declaration = std::ranges::find(all, operation, &ride::Declaration::number);
  if (declaration == all.end()) return ride::Executed::kNoSuchOperation;
  reply.demand(name_, access_of(*declaration));
  const auto run = connection();
  if (run == nullptr) throw ride::Failure("nothing runs");
  const Encoded asked{parameters.take_rest()};
  const ride::Origin origin = reply.origin();
  const std::string_view name = name_in(declaration->canonical);
  if (!may_pass(*run->learned, name, asked.body, origin)) return ride::Executed::kMalformed;
  if (name == "watch" || name == "watched" || name == "end_watch") {
    if (serve_watch(*run, name, asked.body, reply)) return ride::Executed::kDone;
    leave(*run->learned, origin);
    return ride::Executed::kMalformed;
  }
  const bool begins = name == "begin";
  const auto owed = std::make_shared<ride::PendingReply>(reply.keep());
  const auto hand_back = [owed, learned = run->learned, origin, begins](
                             ride::Code code, std::string_view text,
                             std::span<const std::byte> result) {
    leave(*learned, origin);
    if (code != ride::Code::kNone) return owed->fail(text);
    if (begins) take_begun(*learned, result, origin);
    owed->put(Encoded{result});
  };
  run->inspector.ask(operation, {}, ride::Fields(std::tie(asked)), hand_back);
  return ride::Executed::kDone;
}

/// Of the one watch that the run has for all pages.
/// @return false if the body is not the operation's
bool Relay::serve_watch(Connection& run, std::string_view operation,
                        std::span<const std::byte> body, ride::Reply& reply) {
  ride::Decoder from(body);
  std::vector<std::string> items;
  double interval = 0.0;
  std::int32_t handle = 0;
  const bool begins = operation == "watch";
  if (begins && (!from.take(items) || !from.take(interval))) return false;
  if (!begins && !from.take(handle)) return false;
  const auto owed = std::make_shared<ride::PendingReply>(reply.keep());
  const auto answered = [owed, learned = run.learned, origin = reply.origin()](const auto& result) {
    leave(*learned, origin);
    if (!result) return owed->fail(result.error());
    owed->put(result.value());
  };
  if (begins) {
    run.watches->watch(run, std::move(items), interval, reply.origin(), answered);
  } else if (operation == "watched") {
    run.watches->watched(run, handle, answered);
  } else {
    answered(base::Result<bool>(run.watches->end(handle)));
  }
  return true;
}

/// A request of it waits no more.
void Relay::leave(Learned& learned, const ride::Origin& origin) {
  const std::scoped_lock lock(learned.mutex);
  const auto own = std::ranges::find(learned.waiting, origin);
  if (own != learned.waiting.end()) learned.waiting.erase(own);
}

/// Throws if it may not. What passes is counted among what waits.
/// @return false if the body is not the operation's
bool Relay::may_pass(Learned& learned, std::string_view operation, std::span<const std::byte> body,
                     const ride::Origin& origin) {
  const bool called = operation == "call" || operation == "begin";
  const bool written = operation == "write";
  const bool foxglove = is_foxglove(origin);
  if (foxglove && !written && access_named(operation) != ride::Access::kRead) {
    throw ride::Failure("nothing is called, begun, started or paced by Foxglove");
  }
  ride::Decoder names(body);
  std::string component_or_item;
  std::string member;
  if ((called || written) && !names.take(component_or_item)) return false;
  if (called && !names.take(member)) return false;
  const std::scoped_lock lock(learned.mutex);
  const auto own = static_cast<std::size_t>(std::ranges::count(learned.waiting, origin));
  if (own >= kMostOfOne || learned.waiting.size() >= kMostOfAll) {
    throw ride::Failure("the run has too many requests to answer: ask again, and less often");
  }
  if (called) {
    let_through(learned.acts.of_operation(component_or_item, member),
                component_or_item + "." + member, true, origin);
  } else if (written) {
    let_through(learned.acts.of_item(component_or_item), component_or_item, false, origin);
    if (foxglove) demand_seat(component_or_item, origin);
  }
  learned.waiting.push_back(origin);
  return true;
}

/// It shows no operator what else the robot does: it sets nothing beside who sits there.
void Relay::demand_seat(const std::string& what, const ride::Origin& origin) {
  const auto sits = seat_.demand(origin);
  if (!sits) {
    throw ride::Failure("'" + what +
                        "' is set by Foxglove from the operator's seat only, which is handed over "
                        "in the studio: " +
                        sits.error());
  }
}

void Relay::let_through(Act act, const std::string& what, bool with_key,
                        const ride::Origin& origin) {
  if (act == Act::kAnybodys) return;
  if (act == Act::kUnknown) {
    throw ride::Failure("unknown '" + what + "': what runs has not described it");
  }
  const auto allowed =
      with_key ? seat_.use_key(origin, platform::monotonic_now()) : seat_.demand(origin);
  if (!allowed) throw ride::Failure("'" + what + "' is an act of the operator: " + allowed.error());
}

}  // namespace armature::studio::internal
