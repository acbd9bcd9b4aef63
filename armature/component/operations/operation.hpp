// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/by_operator.hpp"
#include "armature/component/component.hpp"
#include "armature/component/context.hpp"
#include "armature/component/internal/inside.hpp"
#include "armature/component/operations/call.hpp"
#include "armature/component/operations/requirement.hpp"
#include "armature/component/operations/signature.hpp"

namespace armature::component {

class StandIn;

/// Option of an operation: it is executed by its component's thread, in the order of the calls;
/// without it, it runs in the thread of the caller.
struct InOwnThread {};
inline constexpr InOwnThread in_own_thread{};

/// Option of an operation: it is served as long as its component is configured, also behind a
/// fault. For what makes safe: brakes, switches off. A command is served before the configuration,
/// too, and ends before it returns where its component does not run.
struct InAnyState {};
inline constexpr InAnyState in_any_state{};

/// Option of an operation or command: names of the arguments, `args("position [rad]", "time [s]")`.
struct ArgumentNames {
  std::array<std::string_view, 6> names{};
};
template <typename... Names>
ArgumentNames args(Names... names) {
  return {{std::string_view(names)...}};
}

/// A function of a component that its peers may call: the runtime's side of it.
class OperationBase {
 public:
  OperationBase(const OperationBase&) = delete;
  OperationBase& operator=(const OperationBase&) = delete;
  virtual ~OperationBase();

  std::string_view name() const;
  std::string_view doc() const;
  const Signature& signature() const;
  Component& owner() const { return owner_; }
  bool runs_in_own_thread() const;
  bool is_by_operator() const;
  /// False while the property of its option `only_if` is false: peers, tools and scripts have no
  /// such operation then.
  bool is_offered() const;
  /// Why it is not offered, for a message.
  std::string why_not_offered() const;
  /// Its component stands for one that lives elsewhere.
  bool is_elsewhere() const;
  /// True if accepting it is not the end of it: it has progress and completion.
  virtual bool is_command() const { return false; }

  /// Calls it with values of the argument types, for tools; the result if it has one.
  /// @thread the component's own
  virtual base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments);

  /// Executes it in its own thread, for nobody who runs there.
  /// @param arguments  where they are, as the signature has them
  /// @param result     where it goes; nullptr if there is none
  CallStatus execute_by_message(const void* const* arguments, void* result) noexcept;
  /// The same here, for a component that calls out (see internal::Inside::call_out).
  /// @param where  the context of the calling thread
  CallStatus execute_here(ExecutionContext& where, const void* const* arguments,
                          void* result) noexcept;

  /// An operation of the same name and signature that `owner` passes on; it keeps the names of this
  /// one, which outlives it.
  /// @thread configuration only
  std::unique_ptr<OperationBase> twin(StandIn& owner) const;

 protected:
  using ExecuteFrom = CallStatus (*)(OperationBase&, ExecutionContext&,
                                     const void* const* arguments, void* result) noexcept;

  /// @param execute_from  nullptr for a command, which is begun
  OperationBase(Component& owner, std::string_view name, std::string_view doc, Signature signature,
                ExecuteFrom execute_from) noexcept;
  void apply(InOwnThread) noexcept;
  void apply(ByOperator) noexcept;
  void apply(InAnyState) noexcept;
  void apply(const ArgumentNames& given) noexcept;
  void apply(Wanted option) noexcept;

  /// Whether it is served now although its component is not ready.
  bool serves_unready() const;
  /// Whether it is served as long as its component is configured.
  bool serves_in_any_state() const;
  /// What it runs if that is no member function.
  void set_free_function(FreeFunction function) noexcept;
  FreeFunction free_function() const noexcept;
  /// Has the stand-in that owns it call its original.
  CallStatus pass_on(ExecutionContext& where, const void* const* arguments, void* result) noexcept;
  /// What is wrong with `arguments`, empty if nothing.
  std::string mismatch(const std::vector<types::Value>& arguments) const;

 private:
  /// What is seldom needed lies apart, as for ports.
  struct About;

  virtual std::unique_ptr<OperationBase> make_twin(Component& owner) const = 0;
  std::string refusal_of_sealed() const;

  Component& owner_;
  std::unique_ptr<About> about_;
};

template <typename Function>
class Operation;
template <typename Function>
class OperationCaller;

/// An operation that returns R and takes Args: a member function that peers, scripts and tools
/// call.
template <typename R, typename... Args>
class Operation<R(Args...)> final : private OperationBase {
 public:
  /// Options: in_own_thread, by_operator, in_any_state, only_if(property), args(names...).
  template <auto Function, typename... Options>
  Operation(Component* owner, std::string_view name, Serve<Function>, std::string_view doc,
            Options... options) noexcept
      : Operation(*owner, name, doc,
                  [](Operation& operation, ExecutionContext& where, Args... arguments) noexcept {
                    return operation.execute_with(where, [&]() -> R {
                      using Owner = internal::OwnerOf<Function>;
                      static_assert(
                          std::is_invocable_r_v<R, decltype(Function), Owner&, Args...>,
                          "the member function does not fit the signature of the operation");
                      auto& component = static_cast<Owner&>(operation.owner());
                      return (component.*Function)(static_cast<Args>(arguments)...);
                    });
                  }) {
    (apply(options), ...);
  }

  /// For operations that are not a member function's: `function` is given `self`.
  template <typename... Options>
  Operation(Component* owner, std::string_view name, R (*function)(void* self, Args...), void* self,
            std::string_view doc, Options... options) noexcept
      : Operation(*owner, name, doc, function, self) {
    (apply(options), ...);
  }

 private:
  using RuntimeFace = OperationBase;
  friend class internal::Inside;
  friend class OperationCaller<R(Args...)>;

  /// Executes it here, for a component that calls out (see internal::Inside::call_out).
  /// @param where  the context of the calling thread
  CallResult<R> execute(ExecutionContext& where, Args... arguments) noexcept {
    return execute_(*this, where, static_cast<Args>(arguments)...);
  }

  using Execute = CallResult<R> (*)(Operation&, ExecutionContext&, Args...) noexcept;
  using Function = R (*)(void* self, Args...);

  Operation(Component& owner, std::string_view name, std::string_view doc, Execute service) noexcept
      : OperationBase(owner, name, doc, Signature::of<R, Args...>({}), &execute_from),
        execute_(service) {}
  Operation(Component& owner, std::string_view name, std::string_view doc, Function function,
            void* self) noexcept
      : Operation(owner, name, doc,
                  [](Operation& operation, ExecutionContext& where, Args... arguments) noexcept {
                    return operation.execute_with(where, [&]() -> R {
                      const FreeFunction free = operation.free_function();
                      return free.as<Function>()(free.self, static_cast<Args>(arguments)...);
                    });
                  }) {
    set_free_function(FreeFunction::of(function, self));
  }

  template <typename Code>
  CallResult<R> execute_with(ExecutionContext& where, Code&& code) noexcept {
    Component& component = owner();
    if (!component.ready() && !serves_unready()) return {CallStatus::kNotReady};
    CallResult<R> result{CallStatus::kFailed};
    internal::Inside::enter_hook(component, where, [&] {
      if constexpr (std::is_void_v<R>) {
        code();
      } else {
        result.value = code();
      }
      result.status = CallStatus::kDone;
    });
    return result;
  }

  static CallStatus execute_from(OperationBase& base, ExecutionContext& where,
                                 [[maybe_unused]] const void* const* arguments,
                                 [[maybe_unused]] void* result) noexcept {
    auto& operation = static_cast<Operation&>(base);
    CallResult<R> answer = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return operation.execute(where, *static_cast<const std::decay_t<Args>*>(arguments[I])...);
    }
    (std::index_sequence_for<Args...>{});
    if constexpr (!std::is_void_v<R>) {
      if (answer) *static_cast<std::decay_t<R>*>(result) = std::move(answer.value);
    }
    return answer.status;
  }

  std::unique_ptr<OperationBase> make_twin(Component& owner) const override {
    const auto service = [](Operation& operation, ExecutionContext& where,
                            Args... arguments) noexcept -> CallResult<R> {
      const std::array<const void*, sizeof...(Args)> places{&arguments...};
      CallResult<R> result;
      void* place = nullptr;
      if constexpr (!std::is_void_v<R>) place = &result.value;
      result.status = operation.pass_on(where, places.data(), place);
      return result;
    };
    return std::unique_ptr<OperationBase>(new Operation(owner, name(), doc(), Execute(service)));
  }

  Execute execute_;
};

/// How many sent calls of one caller may be under way; one more is answered kQueueFull.
struct Outstanding {
  std::size_t count;
};
inline Outstanding outstanding(std::size_t count) { return {count}; }
inline constexpr std::size_t kDefaultOutstanding = 4;

/// A component's declared use of an operation of one of its peers: the runtime's side of it.
class OperationCallerBase : public Requirement {
 public:
  ~OperationCallerBase() override;

  const Signature& signature() const;
  OperationBase* target() const { return operation_; }
  bool bound() const override { return operation_ != nullptr; }

  /// Calls that were not taken because too many were under way.
  std::uint64_t refused() const;

  /// True if it uses a command with completion, false if a plain operation.
  virtual bool needs_command() const { return false; }

  /// Connects to `operation`, which has the same signature, for the threads that both components
  /// are assigned to.
  /// @thread configuration only
  virtual void connect(OperationBase& operation);
  virtual void disconnect();

 protected:
  OperationCallerBase(Component& owner, std::string_view name, std::string_view doc,
                      Signature signature) noexcept;

  using Requirement::apply;
  void apply(Outstanding option) noexcept;
  std::size_t outstanding() const;
  void count_refused();

  /// @param arguments  where they are, as the signature has them
  SentCall send_from(const void* const* arguments);
  void prepare_from(const void* const* arguments);
  /// The operation lives elsewhere, and this thread waits for nobody.
  bool would_wait() const;
  /// This thread may run the operation, which has no C++ types.
  bool calls_described() const;
  CallStatus call_described(const void* const* arguments, void* result);

  OperationBase* operation_ = nullptr;
  bool direct_ = false;     ///< a call runs here, by its C++ types
  bool described_ = false;  ///< the operation is a DescribedOperation

 private:
  struct About;
  About& about() const;
};
/// Calls an operation of a peer that returns R and takes Args.
template <typename R, typename... Args>
class OperationCaller<R(Args...)> final : private OperationCallerBase {
 public:
  using OperationCallerBase::bound;

  /// Options: from(property), optional, only_if(property), outstanding(n).
  template <typename... Options>
  OperationCaller(Component* owner, std::string_view name, std::string_view doc,
                  Options... options) noexcept
      : OperationCaller(*owner, name, doc) {
    (apply(options), ...);
  }

  /// Calls and waits for the result. An operation of this thread runs at once, and so does one of a
  /// thread that does not run yet or any more; else it is queued there and waited for, at most one
  /// second. Messages to the caller's own thread wait meanwhile.
  /// @rt nonblocking if the operation runs in the caller's thread, else it waits
  /// @thread the component's own
  CallResult<R> operator()(Args... arguments) {
    if (operation_ == nullptr) [[unlikely]]
      return {CallStatus::kNotConnected};
    if (direct_ || (!described_ && internal::Inside::context(operation_->owner())
                                       .shares_thread_with(internal::Inside::context(owner())))) {
      auto& operation = static_cast<Operation<R(Args...)>&>(*operation_);
      CallResult<R> result{};
      internal::Inside::call_out(owner(), operation.owner(), [&] {
        result =
            operation.execute(internal::Inside::context(owner()), static_cast<Args>(arguments)...);
      });
      return result;
    }
    return send_and_wait(static_cast<Args>(arguments)...);
  }

  /// Queues the call for the operation's own thread and returns at once.
  /// @rt nonblocking; allocates only to make room for larger vectors than ever sent
  /// @thread the component's own
  SendHandle<R> send(Args... arguments) {
    const std::array<const void*, sizeof...(Args)> places{&arguments...};
    return SendHandle<R>(send_from(places.data()));
  }

  /// Gives the queue's memory the shape of these arguments, so that sending them never allocates.
  void prepare(Args... sample) {
    const std::array<const void*, sizeof...(Args)> places{&sample...};
    prepare_from(places.data());
  }

 private:
  using RuntimeFace = OperationCallerBase;
  friend class internal::Inside;

  static constexpr base::Duration kCallLimit = std::chrono::seconds(1);

  OperationCaller(Component& owner, std::string_view name, std::string_view doc) noexcept
      : OperationCallerBase(owner, name, doc, Signature::of<R, Args...>({})) {}

  [[gnu::noinline]] CallResult<R> send_and_wait(Args... arguments) {
    if (would_wait()) return {CallStatus::kWouldWait};
    if (calls_described()) {
      const std::array<const void*, sizeof...(Args)> places{&arguments...};
      CallResult<R> result{};
      void* place = nullptr;
      if constexpr (!std::is_void_v<R>) place = &result.value;
      result.status = call_described(places.data(), place);
      return result;
    }
    return send(static_cast<Args>(arguments)...).wait(kCallLimit);
  }
};

// Compiled once, in the library.
extern template class Operation<void()>;
extern template class Operation<bool()>;
extern template class Operation<double()>;
extern template class Operation<void(double)>;
extern template class OperationCaller<void()>;
extern template class OperationCaller<bool()>;
extern template class OperationCaller<double()>;
extern template class OperationCaller<void(double)>;

}  // namespace armature::component
