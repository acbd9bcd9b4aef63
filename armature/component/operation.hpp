// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/by_operator.hpp"
#include "armature/component/call.hpp"
#include "armature/component/component.hpp"
#include "armature/component/requirement.hpp"
#include "armature/component/signature.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

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

/// A function of a component that its peers may call.
class OperationBase {
 public:
  OperationBase(const OperationBase&) = delete;
  OperationBase& operator=(const OperationBase&) = delete;
  virtual ~OperationBase();

  std::string_view name() const { return about_->name; }
  std::string_view doc() const { return about_->doc; }
  const Signature& signature() const { return about_->signature; }
  Component& owner() const { return owner_; }
  bool runs_in_own_thread() const { return about_->own_thread; }
  bool is_by_operator() const { return about_->by_operator; }
  /// Its component stands for one that lives elsewhere.
  bool is_elsewhere() const { return about_->elsewhere; }
  /// True if accepting it is not the end of it: it has progress and completion.
  virtual bool is_command() const { return false; }

  /// Calls it with values of the argument types, for tools; the result if it has one.
  /// @thread the component's own
  virtual base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments) = 0;

  /// An operation of the same name and signature that `owner` passes on; it keeps the names of this
  /// one, which outlives it.
  /// @thread configuration only
  virtual std::unique_ptr<OperationBase> twin(StandIn& owner) const = 0;

 protected:
  /// What is seldom needed lies apart, as for ports.
  struct About {
    About(std::string_view its_name, std::string_view its_doc, Signature its_signature,
          bool its_own_thread);
    virtual ~About();

    std::string_view name;
    std::string_view doc;
    Signature signature;
    bool own_thread;
    bool by_operator = false;
    bool elsewhere = false;
    bool any_state = false;
  };

  OperationBase(Component& owner, std::unique_ptr<About> about) noexcept;
  About& about() const { return *about_; }
  void apply(InOwnThread) noexcept { about_->own_thread = true; }
  void apply(ByOperator) noexcept { about_->by_operator = true; }
  void apply(InAnyState) noexcept { about_->any_state = true; }
  /// Whether it is served now although its component is not ready.
  bool serves_unready() const;
  void apply(const ArgumentNames& given) noexcept;
  /// What its twin has of this one besides name and arguments.
  void mark_twin(OperationBase& twin) const;
  /// What is wrong with `arguments`, empty if nothing.
  std::string mismatch(const std::vector<types::Value>& arguments) const;
  std::string refusal_of_sealed() const;
  /// What `invoke` says of a call that did not succeed.
  base::Error failure(CallStatus status) const;

 private:
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
class Operation<R(Args...)> final : public OperationBase {
 public:
  /// Options: in_own_thread, by_operator, in_any_state, args(names...).
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
  ~Operation() override;

  /// Executes it here, for a component that calls out (see Component::call_out).
  /// @param where  the context of the calling thread
  CallResult<R> execute(ExecutionContext& where, Args... arguments) noexcept {
    return execute_(*this, where, static_cast<Args>(arguments)...);
  }
  /// Executes it in its own thread, for nobody who runs there.
  CallResult<R> execute_by_message(Args... arguments) noexcept;

  base::Result<std::optional<types::Value>> invoke(
      const std::vector<types::Value>& arguments) override;

  std::unique_ptr<OperationBase> twin(StandIn& owner) const override;

 private:
  using Execute = CallResult<R> (*)(Operation&, ExecutionContext&, Args...) noexcept;

  Operation(Component& owner, std::string_view name, std::string_view doc,
            Execute service) noexcept;
  Operation(Component& owner, std::string_view name, std::string_view doc,
            R (*function)(void* self, Args...), void* self) noexcept;

  template <std::size_t... I>
  base::Result<std::optional<types::Value>> invoke_with(const std::vector<types::Value>& arguments,
                                                        std::index_sequence<I...>);

  template <typename Code>
  CallResult<R> execute_with(ExecutionContext& where, Code&& code) noexcept {
    Component& component = owner();
    if (!component.ready() && !serves_unready()) return {CallStatus::kNotReady};
    CallResult<R> result{CallStatus::kFailed};
    component.enter_hook(where, [&] {
      if constexpr (std::is_void_v<R>) {
        code();
      } else {
        result.value = code();
      }
      result.status = CallStatus::kDone;
    });
    return result;
  }

  struct About final : OperationBase::About {
    using OperationBase::About::About;
    ~About() override;
    R (*function)(void* self, Args...) = nullptr;
    void* self = nullptr;
  };
  About& about() const { return static_cast<About&>(OperationBase::about()); }

  Execute execute_;
};

/// A component's declared use of an operation of one of its peers.
class OperationCallerBase : public Requirement {
 public:
  ~OperationCallerBase() override;

  const Signature& signature() const { return about().signature; }
  OperationBase* target() const { return about().target; }
  bool bound() const override { return target() != nullptr; }

  /// Calls that were not taken because too many were under way.
  std::uint64_t refused() const { return about().refused; }

  /// True if it uses a command with completion, false if a plain operation.
  virtual bool needs_command() const { return false; }

  /// Connects to `operation`, which has the same signature, for the threads that both components
  /// are assigned to.
  /// @thread configuration only
  virtual void connect(OperationBase& operation) = 0;
  virtual void disconnect() = 0;

 protected:
  /// Description, counters and lists, apart from what a cycle touches.
  struct About : Requirement::About {
    About(std::string_view its_name, std::string_view its_doc, Signature its_signature);
    ~About() override;

    Signature signature;
    OperationBase* target = nullptr;
    std::uint64_t refused = 0;
  };

  OperationCallerBase(Component& owner, std::unique_ptr<About> about) noexcept;
  About& about() const { return static_cast<About&>(Requirement::about()); }
};

/// How many sent calls of one caller may be under way; one more is answered kQueueFull.
struct Outstanding {
  std::size_t count;
};
inline Outstanding outstanding(std::size_t count) { return {count}; }
inline constexpr std::size_t kDefaultOutstanding = 4;

/// Calls an operation of a peer that returns R and takes Args.
template <typename R, typename... Args>
class OperationCaller<R(Args...)> final : public OperationCallerBase {
 public:
  /// Options: from(property), optional, only_if(property), outstanding(n).
  template <typename... Options>
  OperationCaller(Component* owner, std::string_view name, std::string_view doc,
                  Options... options) noexcept
      : OperationCaller(*owner, name, doc) {
    (apply(options), ...);
  }
  ~OperationCaller() override;

  /// Calls and waits for the result. An operation of this thread runs at once, and so does one of a
  /// thread that does not run yet or any more; else it is queued there and waited for, at most one
  /// second. Messages to the caller's own thread wait meanwhile.
  /// @rt nonblocking if the operation runs in the caller's thread, else it waits
  /// @thread the component's own
  CallResult<R> operator()(Args... arguments) {
    if (operation_ == nullptr) [[unlikely]]
      return {CallStatus::kNotConnected};
    if (direct_ || operation_->owner().context().shares_thread_with(owner().context())) {
      CallResult<R> result{};
      owner().call_out(operation_->owner(), [&] {
        result = operation_->execute(owner().context(), static_cast<Args>(arguments)...);
      });
      return result;
    }
    return send_and_wait(static_cast<Args>(arguments)...);
  }

  /// Queues the call for the operation's own thread and returns at once.
  /// @rt nonblocking; allocates only to make room for larger vectors than ever sent
  /// @thread the component's own
  SendHandle<R> send(Args... arguments);

  /// Gives the queue's memory the shape of these arguments, so that sending them never allocates.
  void prepare(Args... sample);

  void connect(OperationBase& base) override;
  void disconnect() override;

 private:
  static constexpr base::Duration kCallLimit = std::chrono::seconds(1);

  OperationCaller(Component& owner, std::string_view name, std::string_view doc) noexcept;
  [[gnu::noinline]] CallResult<R> send_and_wait(Args... arguments);

  struct Record;
  struct About final : OperationCallerBase::About {
    using OperationCallerBase::About::About;
    ~About() override;
    std::size_t outstanding = kDefaultOutstanding;
    std::vector<std::unique_ptr<Record, SharedRecord::LetGo>> records;
    std::size_t next = 0;
  };
  About& about() const { return static_cast<About&>(OperationCallerBase::about()); }

  using OperationCallerBase::apply;
  void apply(Outstanding option) noexcept { about().outstanding = option.count; }

  Operation<R(Args...)>* operation_ = nullptr;
  bool direct_ = false;  ///< a call runs here
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

#include "armature/component/internal/operation_definitions.hpp"
