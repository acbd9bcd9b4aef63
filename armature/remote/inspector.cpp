// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/inspector.hpp"

#include <atomic>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/unit.hpp"
#include "armature/component/author.hpp"
#include "armature/inspect/items.hpp"
#include "armature/platform/clock.hpp"
#include "armature/remote/inspection.hpp"
#include "armature/remote/internal/begun_commands.hpp"
#include "armature/types/elements.hpp"
#include "inspection_service.hpp"

namespace armature::remote {

using namespace inspect;
namespace {

using component::Component;
using ride::Access;
using ride::Failure;
using ride::ReplyOf;

/// Errors of the application name the object themselves when they begin with it in quotes.
std::string with_name(const std::string& name, const std::string& error) {
  return error.starts_with('\'') ? error : name + ": " + error;
}

/// A value of `type`; `what` names it in an error.
types::Value value_of(const types::Type& type, const std::string& text, const std::string& what) {
  types::Value value(type);
  const auto read = types::from_text(type, text, value.data());
  if (!read) throw Failure(what + ": " + read.error());
  return value;
}

/// A number with a unit in the property's own.
std::string in_unit_of(const component::PropertyBase& property, const std::string& text,
                       const std::string& name) {
  const auto quantity = base::parse_quantity(text);
  if (!quantity || quantity.value().unit.empty() || !types::is_number(property.type())) return text;
  const auto number =
      base::convert(quantity.value().value, quantity.value().unit, std::string(property.unit()));
  if (!number) throw Failure(name + ": " + number.error());
  return types::Value::of(number.value()).text();
}

}  // namespace

class Inspector::Service final : public InspectorService {
 public:
  Service(exec::Application& application, ControlQueue& queue, Tell tell)
      : application_(application), queue_(queue), tell_(std::move(tell)) {}

  /// What goes on for a peer ends with its connection: commands, and the way of a component to its
  /// stop, on which an arm may move.
  void cancel_lost() {
    const base::Time now = platform::monotonic_now();
    commands_.cancel_lost(now, tell_);
    std::erase_if(stops_, [&](PeerStop& stop) {
      if (!application_.is_on_way_to_stop(stop.component)) return true;
      if (!stop.line.lost(now)) return false;
      application_.cancel_way_to_stop(stop.component);
      return true;
    });
  }

  void application(ReplyOf<ApplicationStatus> reply) override {
    in_control(reply, [this] { return status_of(application_); });
  }

  void components(ReplyOf<std::vector<ComponentStatus>> reply) override {
    in_control(reply, [this, readable = readable(reply)] {
      std::vector<ComponentStatus> all;
      for (Component* const component : readable)
        all.push_back(status_of(application_, *component));
      return all;
    });
  }

  void faults(ReplyOf<Faults> reply) override {
    in_control(reply,
               [this, readable = readable(reply)] { return faults_of(application_, readable); });
  }

  void describe(const std::string& component, ReplyOf<ComponentDetails> reply) override {
    reply.demand(component, Access::kRead);
    in_control(reply, [this, component] { return details_of(application_, find(component)); });
  }

  void read(const std::vector<std::string>& items, ReplyOf<std::vector<ItemValue>> reply) override {
    if (items.size() > kMostItems) {
      throw Failure("at most " + std::to_string(kMostItems) + " values are read at once, not " +
                    std::to_string(items.size()));
    }
    for (const std::string& item : items) reply.demand(component_in(item), Access::kRead);
    in_control(reply, [this, items] { return values_of(application_, items); });
  }

  void write(const std::string& item, const std::string& value, ReplyOf<ItemValue> reply) override {
    reply.demand(component_in(item), Access::kConfigure);
    in_control(reply, [this, item, value] { return write(item, value); });
  }

  void call(const std::string& component, const std::string& operation,
            const std::vector<std::string>& arguments, ReplyOf<CallResult> reply) override {
    reply.demand(component, Access::kCommand);
    in_control(reply, [this, component, operation, arguments] {
      const std::string name = component + "." + operation;
      const auto answer =
          application_.call(component, operation, arguments_of(component, operation, arguments),
                            exec::Caller::kRemote);
      if (!answer) throw Failure(with_name(name, answer.error()));
      const auto& result = answer.value();
      return result ? CallResult{true, result->type().name, result->text()} : CallResult{};
    });
  }

  void begin(const std::string& component, const std::string& command,
             const std::vector<std::string>& arguments, ReplyOf<CommandStatus> reply) override {
    reply.demand(component, Access::kCommand);
    in_control(reply, [this, component, command, arguments, origin = reply.origin()] {
      return begin(component, command, arguments, origin);
    });
  }

  void follow(std::int32_t handle, ReplyOf<CommandStatus> reply) override {
    reply.demand(component_of(handle), Access::kRead);
    in_control(reply, [this, handle] { return status_of_command(begun(handle)); });
  }

  void cancel(std::int32_t handle, ReplyOf<CommandStatus> reply) override {
    reply.demand(component_of(handle), Access::kCommand);
    in_control(reply, [this, handle] {
      internal::BegunCommand& command = begun(handle);
      command.state.handle().cancel();
      return status_of_command(command);
    });
  }

  void change(const std::string& component, const std::string& change,
              ReplyOf<ComponentStatus> reply) override {
    reply.demand(component, Access::kConfigure);
    const Transition transition = transition_named(change);
    in_control(reply, [this, component, transition, origin = reply.origin()] {
      Component& found = find(component);
      const bool was_on_way = application_.is_on_way_to_stop(component);
      const component::Outcome outcome = (application_.*transition)(component);
      if (!outcome) throw Failure(with_name(component, std::string(outcome.reason())));
      if (!was_on_way && application_.is_on_way_to_stop(component)) {
        stops_.push_back({component, ride::Lifeline(origin)});
      }
      return status_of(application_, found);
    });
  }

 private:
  /// A component that does something before the stop that a peer asked for.
  struct PeerStop {
    std::string component;
    ride::Lifeline line;
  };
  using Transition = component::Outcome (exec::Application::*)(std::string_view);

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

  static Transition transition_named(const std::string& name) {
    if (name == "start") return &exec::Application::start_component;
    if (name == "stop") return &exec::Application::stop_component;
    if (name == "reset") return &exec::Application::reset_component;
    if (name == "recover") return &exec::Application::recover_component;
    if (name == "cleanup") return &exec::Application::clean_up_component;
    throw Failure("a component's change is start, stop, reset, recover or cleanup, not '" + name +
                  "'");
  }

  template <typename T>
  Components readable(const ReplyOf<T>& reply) const {
    Components all;
    for (const exec::ComponentEntry& entry : application_.blueprint().components) {
      if (reply.allows(entry.component->name(), Access::kRead))
        all.push_back(entry.component.get());
    }
    return all;
  }

  Component& find(const std::string& name) const {
    if (Component* const found = application_.find(name)) return *found;
    throw Failure(no_component(application_, name));
  }

  /// The component that an item begins with. What is none is refused as such by who looks for it,
  /// if the policy lets the sender know.
  std::string component_in(const std::string& item) const {
    const Component* const found = leading_component(application_, item, ".:");
    return found != nullptr ? found->name() : item.substr(0, item.find_first_of(".:["));
  }

  ItemValue write(const std::string& text, const std::string& value) {
    const base::Result<Item> item = find_item(application_, text);
    if (!item) throw Failure(item.error());
    const Member& member = item.value().member;
    const std::string name = member.name();
    if (member.property == nullptr) {
      throw Failure("'" + name + "' is a port: only components write it");
    }
    if (!item.value().parts.empty()) {
      throw Failure("'" + text + "' is a part: set the whole, " + name + " = ...");
    }
    const types::Value wanted =
        remote::value_of(member.type(), in_unit_of(*member.property, value, name), name);
    const auto set = application_.set_property(member.component->name(), member.property->name(),
                                               wanted, exec::Caller::kRemote);
    if (!set) throw Failure(set.error());
    return values_of(application_, {text}).front();
  }

  std::vector<types::Value> arguments_of(const std::string& component_name,
                                         const std::string& operation_name,
                                         const std::vector<std::string>& given) const {
    const base::Result<Member> member =
        find_member(application_, component_name + ":" + operation_name);
    if (!member) throw Failure(member.error());
    const std::string name = component_name + "." + operation_name;
    if (member.value().operation == nullptr) {
      throw Failure("'" + name + "' is neither an operation nor a command");
    }
    const component::Signature& signature = member.value().operation->signature();
    const auto& wanted = signature.arguments;
    if (given.size() != wanted.size()) {
      throw Failure(name + " takes " + std::to_string(wanted.size()) +
                    (wanted.size() == 1 ? " argument" : " arguments") + ", not " +
                    std::to_string(given.size()) + ": it is " + signature.text());
    }
    std::vector<types::Value> values;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::string label =
          wanted[i].name.empty() ? "" : " (" + std::string(wanted[i].name) + ")";
      values.push_back(remote::value_of(*wanted[i].type, given[i],
                                        name + ": argument " + std::to_string(i + 1) + label));
    }
    return values;
  }

  CommandStatus begin(const std::string& component, const std::string& command,
                      const std::vector<std::string>& arguments, const ride::Origin& origin) {
    const std::string name = component + "." + command;
    if (origin.lost()) throw Failure(name + ": the client that asked for it has gone");
    std::vector<types::Value> values = arguments_of(component, command, arguments);
    if (!commands_.make_room()) {
      throw Failure(name + ": " + std::to_string(kMostCommands) +
                    " commands of other processes are under way: cancel some, or wait");
    }
    auto begun = application_.begin(component, command, std::move(values), exec::Caller::kRemote);
    if (!begun) throw Failure(with_name(name, begun.error()));
    const std::int32_t handle =
        commands_.add(component, command, {std::move(begun).value(), origin});
    return status_of_command(*commands_.find(handle));
  }

  /// For the policy's sake, before anything is done.
  std::string component_of(std::int32_t handle) const {
    if (auto name = commands_.component_of(handle)) return *name;
    throw Failure(unknown_handle(handle));
  }

  internal::BegunCommand& begun(std::int32_t handle) {
    if (internal::BegunCommand* const found = commands_.find(handle)) return *found;
    throw Failure(unknown_handle(handle));
  }

  static std::string unknown_handle(std::int32_t handle) {
    return "unknown command handle " + std::to_string(handle) +
           ": it never began, or has ended and its result is no longer kept";
  }

  static CommandStatus status_of_command(const internal::BegunCommand& command) {
    const component::CommandHandle& state = command.state.handle();
    const bool failed = state.ended() && state.stage() != component::CommandStage::kDone;
    CommandStatus status;
    status.handle = command.handle;
    status.command = command.component + "." + command.command;
    status.stage = component::name_of(state.stage());
    status.ended = state.ended();
    status.progress = state.progress();
    if (failed) status.reason = state.reason();
    return status;
  }

  exec::Application& application_;
  ControlQueue& queue_;
  const Tell tell_;
  std::atomic<std::size_t> waiting_{0};
  internal::BegunCommands commands_{kMostCommands};
  std::vector<PeerStop> stops_;
};

Inspector::Inspector(exec::Application& application, ControlQueue& queue, Tell tell)
    : service_(std::make_unique<Service>(application, queue, std::move(tell))) {}

Inspector::~Inspector() = default;

ride::Service& Inspector::service() { return *service_; }

void Inspector::serve() { service_->cancel_lost(); }

}  // namespace armature::remote
