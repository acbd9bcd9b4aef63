// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/exec/engine.hpp"
#include "armature/testing/internal/fakes.hpp"

namespace armature::testing {

/// One component on the bench: a thread of its own kind with a clock that only the test moves.
///
///     testing::Harness pid(std::make_unique<Pid>("pid"));
///     pid.set("Kp", 2.0);
///     ASSERT_TRUE(pid.start()) << pid.reason();
///     pid.write("Ref", 1.0);
///     EXPECT_EQ(pid.output<double>("Out"), 2.0);
///
/// Everything happens at once and in the calling thread, as real-time code. A name that the
/// component does not have, or a value of another type, throws std::invalid_argument that says what
/// there is.
class Harness {
 public:
  /// @param period  of the cycles that `run_cycles` runs
  explicit Harness(std::unique_ptr<component::Component> component,
                   base::Duration period = std::chrono::milliseconds(1));
  Harness(const Harness&) = delete;
  Harness& operator=(const Harness&) = delete;
  /// Stops the component and cleans it up.
  ~Harness();

  component::Component& component() { return *component_; }
  component::State state() const { return component_->state(); }
  std::string reason() const { return std::string(component_->reason()); }

  /// Sets a property; text is read as in a deployment: `set("Gains", "[1, 2]")`.
  void set(std::string_view property, std::string_view text);
  template <typename T>
  requires(!std::is_convertible_v<const T&, std::string_view>) void set(std::string_view property,
                                                                        const T& value) {
    set(property, types::to_text(types::type_of<T>(), &value));
  }
  template <typename T>
  T get(std::string_view property) {
    const component::PropertyBase& found = find_property(property);
    check_type(found.name(), found.type(), types::type_of<T>());
    return *static_cast<const T*>(found.data());
  }

  /// Configures, activates and starts; the first refusal ends it.
  component::Outcome start();
  void stop() { component::Host::stop(*component_); }

  base::Time now() const { return component_->time(); }
  /// Lets a period pass and runs a cycle, `count` times.
  void run_cycles(int count = 1);
  /// Lets time pass in which no cycle runs.
  void advance(base::Duration time);

  /// Writes to an input, as another component would: its handler or update runs at once if it is
  /// triggered. The first value for a vector gives the connection its size.
  template <typename T>
  void write(std::string_view input, const T& value);
  /// The value last written to an output, and how often it was written.
  template <typename T>
  const T& output(std::string_view name) {
    const component::OutputPortBase& found = find_output(name);
    check_type(found.name(), found.type(), types::type_of<T>());
    return *static_cast<const T*>(found.current());
  }
  std::uint64_t writes(std::string_view output) { return find_output(output).current_sequence(); }

  /// Calls an operation, or begins a command; the error is its refusal or the exception.
  template <typename R = void, typename... Args>
  base::Result<R> call(std::string_view operation, const Args&... arguments);
  /// Sends a command; the handle tells how it fares.
  template <typename... Args>
  component::CommandHandle send(std::string_view command, const Args&... arguments);

  /// What was raised, from now on, each with its arguments.
  template <typename... Args>
  const std::vector<std::tuple<Args...>>& record(std::string_view event);
  /// Has the component handle an event of a peer.
  template <typename... Args>
  void raise(std::string_view handler, const Args&... arguments);
  /// Serves an operation that the component calls: `serve<double()>("read", [] { return 1.0; })`.
  template <typename Function>
  void serve(std::string_view caller, std::function<Function> function);

  /// The log lines until now, `warning: the text`.
  const std::vector<std::string>& log();

 private:
  component::PropertyBase& find_property(std::string_view name) const;
  component::InputPortBase& find_input(std::string_view name) const;
  component::OutputPortBase& find_output(std::string_view name) const;
  component::OperationBase& find_operation(std::string_view name) const;
  component::OperationCallerBase& find_caller(std::string_view name) const;
  component::EventBase& find_event(std::string_view name) const;
  component::EventHandlerBase& find_handler(std::string_view name) const;
  void check_type(std::string_view item, const types::Type& is, const types::Type& given) const;
  void check_result(std::string_view operation, const types::Type* is,
                    const types::Type& wanted) const;
  void check_size(std::string_view input, bool fits) const;
  void check_signature(std::string_view item, const component::Signature& is,
                       const component::Signature& given) const;
  void check_command(std::string_view item, const component::OperationBase& operation) const;

  /// Does `work` in the component's thread.
  template <typename Work>
  void in_thread(Work&& work);
  /// The fake of this kind and name, made and connected if there is none yet.
  template <typename Fake, typename Connect>
  Fake& fake(std::string_view name, const Connect& connect);

  std::unique_ptr<component::Component> component_;
  exec::Engine engine_;
  base::Duration period_;
  base::Time now_{};
  std::vector<std::unique_ptr<component::Component>> fakes_;
  std::vector<std::string> log_;
};

template <typename Work>
void Harness::in_thread(Work&& work) {
  internal::Deed deed(work);
  engine_.context().post(deed);
  engine_.step(now_);
}

template <typename Fake, typename Connect>
Fake& Harness::fake(std::string_view name, const Connect& connect) {
  for (const auto& each : fakes_) {
    auto* const known = dynamic_cast<Fake*>(each.get());
    if (known != nullptr && known->name() == name) return *known;
  }
  auto made = std::make_unique<Fake>(std::string(name));
  component::Host::assign_context(*made, engine_.context());
  static_cast<void>(component::Host::configure(*made));
  static_cast<void>(component::Host::start(*made));
  connect(*made);
  Fake& result = *made;
  fakes_.push_back(std::move(made));
  return result;
}

template <typename T>
void Harness::write(std::string_view name, const T& value) {
  component::InputPortBase& input = find_input(name);
  check_type(name, input.type(), types::type_of<T>());
  auto& writer = fake<internal::Writer<T>>(name, [&](internal::Writer<T>& made) {
    made.port.set_sample(value);
    check_size(name, face(made.port).fits(input));
    face(made.port).connect(input, {});
  });
  auto status = component::WriteStatus::kWritten;
  in_thread([&] { status = writer.port.write(value); });
  check_size(name, status != component::WriteStatus::kWrongSize);
}

template <typename R, typename... Args>
base::Result<R> Harness::call(std::string_view name, const Args&... arguments) {
  component::OperationBase& operation = find_operation(name);
  std::vector<types::Value> values{types::Value::of(internal::owned(arguments))...};
  base::Result<std::optional<types::Value>> answer{std::optional<types::Value>()};
  in_thread([&] {
    const rt::PermitScope permit;  // it travels as a tool's call does
    answer = operation.invoke(values);
  });
  if (!answer) return base::Error{answer.error()};
  if constexpr (std::is_void_v<R>) {
    return {};
  } else {
    const types::Type* const result = operation.signature().result;
    check_result(name, result, types::type_of<R>());
    return *static_cast<const R*>(answer.value()->data());
  }
}

template <typename... Args>
component::CommandHandle Harness::send(std::string_view name, const Args&... arguments) {
  component::OperationBase& operation = find_operation(name);
  check_signature(name, operation.signature(),
                  component::Signature::of<void, internal::Passed<Args>...>({}));
  check_command(name, operation);
  auto& commander = fake<internal::Commander<Args...>>(
      name, [&](auto& made) { face(made.caller).connect(operation); });
  component::CommandHandle handle(component::CallStatus::kPending);
  in_thread([&] {
    const rt::PermitScope permit;  // the first vectors make room for all
    handle = commander.caller.send(arguments...);
  });
  return handle;
}

template <typename... Args>
const std::vector<std::tuple<Args...>>& Harness::record(std::string_view name) {
  component::EventBase& event = find_event(name);
  check_signature(name, event.signature(), component::Signature::of<void, Args...>({}));
  return fake<internal::Listener<Args...>>(name,
                                           [&](auto& made) { event.subscribe(face(made.handler)); })
      .heard;
}

template <typename... Args>
void Harness::raise(std::string_view name, const Args&... arguments) {
  component::EventHandlerBase& handler = find_handler(name);
  check_signature(name, handler.signature(), component::Signature::of<void, Args...>({}));
  const std::array<const void*, sizeof...(Args)> places{&arguments...};
  in_thread([&] { handler.handle_from(engine_.context(), places.data()); });
}

template <typename Function>
void Harness::serve(std::string_view name, std::function<Function> function) {
  component::OperationCallerBase& caller = find_caller(name);
  auto& server = fake<internal::Server<Function>>(name, [&](auto& made) {
    check_signature(name, caller.signature(), face(made.operation).signature());
    caller.connect(face(made.operation));
  });
  server.function = std::move(function);
}

}  // namespace armature::testing
