// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/inspector.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/inspect/items.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/internal/inspection.hpp"
#include "armature/remote/internal/peer_watches.hpp"
#include "armature/ride/origin.hpp"
#include "armature/types/enum.hpp"
#include "inspection_service.hpp"

namespace armature::remote {
namespace {

using internal::each;
using internal::to_wire;
using ride::Access;
using ride::Failure;
using ride::ReplyOf;

constexpr std::size_t kMostWatched = 4096;  ///< items of a watch
constexpr double kLongest = 3600.0;         ///< [s] between two samples of a watch

inspect::LifeCycleChange change_named(const std::string& name) {
  if (const auto change = types::value_named<inspect::LifeCycleChange>(name)) return *change;
  throw Failure("a component's change is start, stop, reset, recover or cleanup, not '" + name +
                "'");
}

/// Commands that were begun for peers: they last no longer than the connections by which they were
/// asked for, since nobody else would take them back.
class PeerCommands {
 public:
  PeerCommands(inspect::ApplicationView& view, const Inspector::Tell& tell)
      : view_(view), tell_(tell) {}

  /// @thread the controlling one
  void add(const inspect::CommandStatus& command, std::string component, ride::Origin origin) {
    const std::lock_guard lock(mutex_);
    std::erase_if(commands_, [&](const PeerCommand& one) { return !view_.remembers(one.handle); });
    commands_.push_back(
        {command.handle, std::move(component), ride::Lifeline(std::move(origin)), false});
  }

  /// Cancels those whose peers have gone, or are silent: what moves comes to rest.
  /// @param now  of the monotonic clock
  /// @thread the controlling one
  void cancel_lost(base::Time now) {
    for (PeerCommand& one : commands_) {
      if (!view_.is_under_way(one.handle) || one.cancelled || !one.line.lost(now)) continue;
      one.cancelled = true;
      const inspect::CommandStatus status = view_.cancel(one.handle);
      if (tell_) {
        tell_("'" + status.name + "' is cancelled: the connection to " + one.line.who() +
              ", which began it, is lost");
      }
    }
  }

  /// The component that a command was given to, for the policy's sake.
  /// @thread any
  std::string component_of(std::int32_t handle) const {
    const std::lock_guard lock(mutex_);
    for (const PeerCommand& one : commands_) {
      if (one.handle == handle) return one.component;
    }
    throw Failure(inspect::ApplicationView::unknown_command(handle));
  }

 private:
  struct PeerCommand {
    std::int32_t handle;
    std::string component;
    ride::Lifeline line;
    bool cancelled;
  };

  inspect::ApplicationView& view_;
  const Inspector::Tell& tell_;
  mutable std::mutex mutex_;
  std::vector<PeerCommand> commands_;  ///< changed by the controlling thread, with the lock
};

}  // namespace

class Inspector::Service final : public InspectorService {
 public:
  Service(exec::Application& application, ControlQueue& queue, Tell tell)
      : application_(application),
        queue_(queue),
        tell_(std::move(tell)),
        view_(application, exec::Caller::kRemote) {}

  /// What goes on for a peer ends with its connection: commands, and the way of a component to its
  /// stop, on which an arm may move.
  void cancel_lost() {
    const base::Time now = platform::monotonic_now();
    commands_.cancel_lost(now);
    watches_.end_lost(now);
    std::erase_if(stops_, [&](PeerStop& stop) {
      if (!application_.is_on_way_to_stop(stop.component)) return true;
      if (!stop.line.lost(now)) return false;
      application_.cancel_way_to_stop(stop.component);
      return true;
    });
  }

  void application(ReplyOf<ApplicationStatus> reply) override {
    in_control(reply, [this] { return to_wire(view_.status()); });
  }

  void components(ReplyOf<std::vector<ComponentStatus>> reply) override {
    in_control(reply, [this, readable = readable(reply)] {
      return each(view_.components(readable), [](const auto& one) { return to_wire(one); });
    });
  }

  void faults(ReplyOf<Faults> reply) override {
    in_control(reply,
               [this, readable = readable(reply)] { return to_wire(view_.faults(readable)); });
  }

  void describe(const std::string& component, ReplyOf<ComponentDetails> reply) override {
    reply.demand(component, Access::kRead);
    in_control(reply, [this, component] {
      return to_wire(view_.describe(component, inspect::Values::kIncluded));
    });
  }

  void connections(ReplyOf<std::vector<ConnectionDetails>> reply) override {
    in_control(reply, [this, readable = readable(reply)] {
      return each(view_.connections(readable), [](const auto& one) { return to_wire(one); });
    });
  }

  void read(const std::vector<std::string>& items, ReplyOf<std::vector<ItemValue>> reply) override {
    if (items.size() > kMostItems) {
      throw Failure("at most " + std::to_string(kMostItems) + " values are read at once, not " +
                    std::to_string(items.size()));
    }
    for (const std::string& item : items) reply.demand(component_in(item), Access::kRead);
    in_control(reply, [this, items] {
      return each(view_.read(items), [](const auto& one) { return to_wire(one); });
    });
  }

  void write(const std::string& item, const std::string& value, ReplyOf<ItemValue> reply) override {
    reply.demand(component_in(item), Access::kConfigure);
    in_control(reply, [this, item, value] { return to_wire(view_.write(item, value)); });
  }

  void call(const std::string& component, const std::string& operation,
            const std::vector<std::string>& arguments, ReplyOf<CallResult> reply) override {
    reply.demand(component, Access::kCommand);
    in_control(reply, [this, component, operation, arguments] {
      return to_wire(view_.call(component, operation, arguments));
    });
  }

  void begin(const std::string& component, const std::string& command,
             const std::vector<std::string>& arguments, ReplyOf<CommandStatus> reply) override {
    reply.demand(component, Access::kCommand);
    in_control(reply, [this, component, command, arguments, origin = reply.origin()] {
      if (origin.lost())
        throw Failure(component + "." + command + ": the client that asked for it has gone");
      const inspect::CommandStatus begun = view_.begin(component, command, arguments);
      commands_.add(begun, component, origin);
      return to_wire(begun);
    });
  }

  void follow(std::int32_t handle, ReplyOf<CommandStatus> reply) override {
    reply.demand(commands_.component_of(handle), Access::kRead);
    in_control(reply, [this, handle] { return to_wire(view_.follow(handle)); });
  }

  void cancel(std::int32_t handle, ReplyOf<CommandStatus> reply) override {
    reply.demand(commands_.component_of(handle), Access::kCommand);
    in_control(reply, [this, handle] { return to_wire(view_.cancel(handle)); });
  }

  void change(const std::string& component, const std::string& name,
              ReplyOf<ComponentStatus> reply) override {
    reply.demand(component, Access::kConfigure);
    in_control(reply, [this, component, change = change_named(name), origin = reply.origin()] {
      const bool was_on_way = application_.is_on_way_to_stop(component);
      const inspect::ComponentStatus now = view_.change(component, change);
      if (!was_on_way && application_.is_on_way_to_stop(component)) {
        stops_.push_back({component, ride::Lifeline(origin)});
      }
      return to_wire(now);
    });
  }

  void watch(const std::vector<std::string>& items, double interval,
             ReplyOf<Watch> reply) override {
    const std::set<std::string> components = components_in(items);
    for (const std::string& component : components) reply.demand(component, Access::kRead);
    const bool sensible = items.size() <= kMostWatched && interval >= 0.0 && interval <= kLongest;
    if (!sensible) {
      throw Failure("a watch has at most " + std::to_string(kMostWatched) +
                    " items, and an interval from 0 to 3600 s");
    }
    in_control(reply, [this, items, components, period = base::from_seconds(interval),
                       origin = reply.origin()] {
      if (origin.lost()) throw Failure("the client that asked for the watch has gone");
      watches_.make_room();
      const inspect::Watch begun = view_.watch(items, period);
      watches_.add(begun, components, origin);
      return to_wire(begun);
    });
  }

  void watched(std::int32_t handle, ReplyOf<WatchedValues> reply) override {
    demand_watch(handle, reply);
    in_control(reply, [this, handle] { return to_wire(view_.watched(handle)); });
  }

  void end_watch(std::int32_t handle, ReplyOf<bool> reply) override {
    demand_watch(handle, reply);
    in_control(reply, [this, handle] { return watches_.end(handle); });
  }

  void cycle(const std::string& thread, ReplyOf<Cycle> reply) override {
    in_control(reply, [this, thread, readable = readable(reply)] {
      return to_wire(view_.cycle(thread, readable));
    });
  }

  void log(std::uint64_t after, ReplyOf<LogLines> reply) override {
    in_control(reply, [this, after, readable = readable(reply)] {
      const std::vector<std::string> names = view_.component_names();
      const std::set<std::string_view> components(names.begin(), names.end());
      return to_wire(view_.log(after, [&](const std::string& writer) {
        return !components.contains(writer) || readable(writer);
      }));
    });
  }

  void pace(ReplyOf<Pace> reply) override {
    in_control(reply, [this] { return to_wire(view_.pace()); });
  }

  void set_pace(const Pace& pace, ReplyOf<Pace> reply) override {
    in_control(reply, [this, wanted = internal::from_wire(pace)] {
      return to_wire(view_.set_pace(wanted));
    });
  }

  void step(ReplyOf<Pace> reply) override {
    in_control(reply, [this] { return to_wire(view_.step()); });
  }

 private:
  /// A component that does something before the stop that a peer asked for.
  struct PeerStop {
    std::string component;
    ride::Lifeline line;
  };

  /// Has the controlling thread do `work` and answer with what it returns.
  template <typename T, typename Work>
  void in_control(ReplyOf<T>& reply, Work work) {
    const auto place = std::make_shared<Place>(waiting_);
    const bool room = place->number <= kMostWaiting;
    const auto kept = std::make_shared<ride::PendingReplyOf<T>>(reply.keep());
    const auto answer = [kept, place, work = std::move(work)] {
      try {
        kept->put(work());
      } catch (const std::exception& failure) {
        kept->fail(failure.what());
      }
    };
    if (!room) {
      kept->fail("the application is busy with other requests: ask again, and less often");
    } else if (!queue_.post(answer)) {
      kept->fail("the application takes no requests now: it stops, or has too many of them");
    }
  }

  /// One of the requests that wait, as long as it does.
  struct Place {
    explicit Place(std::atomic<std::size_t>& count) : all(count), number(++count) {}
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place() { --all; }
    std::atomic<std::size_t>& all;
    const std::size_t number;
  };

  /// Those that the sender may read: decided here, by the node's own thread.
  template <typename T>
  inspect::View::Which readable(const ReplyOf<T>& reply) {
    std::set<std::string> names;
    for (const std::string& name : view_.component_names()) {
      if (reply.allows(name, Access::kRead)) names.insert(name);
    }
    return [names = std::move(names)](const std::string& name) { return names.contains(name); };
  }

  std::set<std::string> components_in(const std::vector<std::string>& items) const {
    std::set<std::string> components;
    for (const std::string& item : items) components.insert(component_in(item));
    return components;
  }

  /// Whoever may read all that a watch shows may have it.
  template <typename T>
  void demand_watch(std::int32_t handle, const ReplyOf<T>& reply) const {
    for (const std::string& component : watches_.components_of(handle)) {
      reply.demand(component, Access::kRead);
    }
  }

  /// The component that an item begins with. What is none is refused as such by who looks for it,
  /// if the policy lets the sender know.
  std::string component_in(const std::string& item) const {
    const component::Component* const found = inspect::leading_component(application_, item, ".:");
    return found != nullptr ? found->name() : item.substr(0, item.find_first_of(".:["));
  }

  exec::Application& application_;
  ControlQueue& queue_;
  const Tell tell_;
  std::atomic<std::size_t> waiting_{0};
  inspect::ApplicationView view_;
  PeerCommands commands_{view_, tell_};
  internal::PeerWatches watches_{view_};
  std::vector<PeerStop> stops_;
};

Inspector::Inspector(exec::Application& application, ControlQueue& queue, Tell tell)
    : service_(std::make_unique<Service>(application, queue, std::move(tell))) {}

Inspector::~Inspector() = default;

ride::Service& Inspector::service() { return *service_; }

void Inspector::serve() { service_->cancel_lost(); }

}  // namespace armature::remote
