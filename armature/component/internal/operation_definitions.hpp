// SPDX-License-Identifier: Apache-2.0
#pragma once

// What of operations and their callers is not in their header: nothing of this is needed at a call
// within one thread.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "armature/component/operation.hpp"
#include "armature/rt/outbox.hpp"

namespace armature::component {

template <typename R, typename... Args>
Operation<R(Args...)>::About::~About() = default;

template <typename R, typename... Args>
Operation<R(Args...)>::Operation(Component& owner, std::string_view name, std::string_view doc,
                                 Execute service) noexcept
    : OperationBase(owner,
                    std::make_unique<About>(name, doc, Signature::of<R, Args...>({}), false)),
      execute_(service) {}

template <typename R, typename... Args>
Operation<R(Args...)>::Operation(Component& owner, std::string_view name, std::string_view doc,
                                 R (*function)(void* self, Args...), void* self) noexcept
    : Operation(owner, name, doc,
                [](Operation& operation, ExecutionContext& where, Args... arguments) noexcept {
                  return operation.execute_with(where, [&]() -> R {
                    const About& about = operation.about();
                    return about.function(about.self, static_cast<Args>(arguments)...);
                  });
                }) {
  about().function = function;
  about().self = self;
}

template <typename R, typename... Args>
Operation<R(Args...)>::~Operation() = default;

template <typename R, typename... Args>
std::unique_ptr<OperationBase> Operation<R(Args...)>::twin(StandIn& owner) const {
  const auto pass_on = [](Operation& operation, ExecutionContext& where,
                          Args... arguments) noexcept -> CallResult<R> {
    if (where.real_time) return {CallStatus::kWouldWait};
    auto& component = static_cast<StandIn&>(operation.owner());
    if (!component.ready()) return {CallStatus::kNotReady};
    CallResult<R> result{CallStatus::kFailed};
    component.enter_hook(where, [&] {
      const std::array<const void*, sizeof...(Args)> places{&arguments...};
      void* place = nullptr;
      if constexpr (!std::is_void_v<R>) place = &result.value;
      result.status = component.call(operation, places.data(), place);
    });
    return result;
  };
  std::unique_ptr<Operation> made(new Operation(owner, name(), doc(), Execute(pass_on)));
  mark_twin(*made);
  return made;
}

template <typename R, typename... Args>
CallResult<R> Operation<R(Args...)>::execute_by_message(Args... arguments) noexcept {
  Component& component = owner();
  CallResult<R> result{};
  component.run(component.context(),
                [&] { result = execute(component.context(), static_cast<Args>(arguments)...); });
  return result;
}

template <typename R, typename... Args>
base::Result<std::optional<types::Value>> Operation<R(Args...)>::invoke(
    const std::vector<types::Value>& arguments) {
  if (std::string problem = mismatch(arguments); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  return invoke_with(arguments, std::index_sequence_for<Args...>{});
}

template <typename R, typename... Args>
template <std::size_t... I>
base::Result<std::optional<types::Value>> Operation<R(Args...)>::invoke_with(
    [[maybe_unused]] const std::vector<types::Value>& arguments, std::index_sequence<I...>) {
  const CallResult<R> result =
      execute_by_message(*static_cast<const std::decay_t<Args>*>(arguments[I].data())...);
  if (result.status != CallStatus::kDone) {
    return failure(result.status);
  }
  if constexpr (std::is_void_v<R>) {
    return std::optional<types::Value>();
  } else {
    return std::optional(types::Value::of<std::decay_t<R>>(result.value));
  }
}

template <typename R, typename... Args>
struct OperationCaller<R(Args...)>::Record final : CallRecord<R> {
  explicit Record(Operation<R(Args...)>& target)
      : CallRecord<R>(&Record::deliver), operation(target) {}
  static void deliver(rt::Message& message) {
    auto& record = static_cast<Record&>(message);
    if (!record.try_begin()) return;
    CallResult<R> result = std::apply(
        [&record](const std::decay_t<Args>&... given) {
          return record.operation.execute_by_message(given...);
        },
        record.arguments);
    rt::send_gathered();  // what the operation wrote is on its way before its caller goes on
    record.finish(std::move(result));
  }
  Operation<R(Args...)>& operation;
  std::tuple<std::decay_t<Args>...> arguments{};
};

template <typename R, typename... Args>
OperationCaller<R(Args...)>::About::~About() = default;

template <typename R, typename... Args>
OperationCaller<R(Args...)>::OperationCaller(Component& owner, std::string_view name,
                                             std::string_view doc) noexcept
    : OperationCallerBase(owner,
                          std::make_unique<About>(name, doc, Signature::of<R, Args...>({}))) {}

template <typename R, typename... Args>
OperationCaller<R(Args...)>::~OperationCaller() = default;

template <typename R, typename... Args>
CallResult<R> OperationCaller<R(Args...)>::send_and_wait(Args... arguments) {
  if (owner().context().real_time && operation_->is_elsewhere()) return {CallStatus::kWouldWait};
  return send(static_cast<Args>(arguments)...).wait(kCallLimit);
}

template <typename R, typename... Args>
SendHandle<R> OperationCaller<R(Args...)>::send(Args... arguments) {
  if (operation_ == nullptr) return SendHandle<R>(CallStatus::kNotConnected);
  About& mine = about();
  for (std::size_t tried = 0; tried < mine.records.size(); ++tried) {
    Record& record = *mine.records[mine.next];
    if (++mine.next == mine.records.size()) mine.next = 0;
    if (!record.try_claim()) continue;
    record.arguments = std::tuple<const std::decay_t<Args>&...>(arguments...);
    operation_->owner().context().post(record);
    return SendHandle<R>(record);
  }
  ++mine.refused;
  return SendHandle<R>(CallStatus::kQueueFull);
}

template <typename R, typename... Args>
void OperationCaller<R(Args...)>::prepare(Args... sample) {
  for (auto& record : about().records) {
    record->arguments = std::tuple<const std::decay_t<Args>&...>(sample...);
  }
}

template <typename R, typename... Args>
void OperationCaller<R(Args...)>::connect(OperationBase& base) {
  operation_ = static_cast<Operation<R(Args...)>*>(&base);
  direct_ = !base.runs_in_own_thread() || &base.owner().context() == &owner().context();
  About& mine = about();
  mine.target = &base;
  mine.records.clear();
  mine.next = 0;
  for (std::size_t i = 0; i < mine.outstanding; ++i) {
    mine.records.emplace_back(new Record(*operation_));
  }
}
template <typename R, typename... Args>
void OperationCaller<R(Args...)>::disconnect() {
  operation_ = nullptr;
  about().target = nullptr;
  about().records.clear();
}

}  // namespace armature::component
