// SPDX-License-Identifier: Apache-2.0
#include "armature/component/untyped.hpp"

#include "armature/component/host.hpp"
#include "armature/component/internal/arguments.hpp"
#include "armature/component/internal/sent_command.hpp"
#include "armature/component/internal/small_type.hpp"
#include "armature/component/operations/call_record.hpp"

namespace armature::component {

UntypedEventHandler::UntypedEventHandler(Component& owner, std::string_view name,
                                         std::string_view doc, const EventBase& like,
                                         Function function, void* self) noexcept
    : EventHandlerBase(owner, name, doc, like.signature()), function_(function), self_(self) {
  apply(leads_to_nothing());
}

void UntypedEventHandler::listen(EventBase& event) { event.add_tap(*this); }

void UntypedEventHandler::listen_no_more(EventBase& event) { event.remove_tap(*this); }

void UntypedEventHandler::event_raised(const void* const* arguments) noexcept {
  Component& raiser = source()->owner();
  Host::call_out(raiser, owner(), [&] { handle_from(Host::context(raiser), arguments); });
}

void UntypedEventHandler::handle_from(ExecutionContext& where,
                                      const void* const* arguments) noexcept {
  handle_with(where, [&] { function_(self_, arguments); });
}

/// A command on its way there, and its end on the way back.
class UntypedCommandCaller::Order final : public internal::SentCommand {
 public:
  Order(UntypedCommandCaller& caller, CommandBase& command)
      : SentCommand(command), caller_(caller) {}

  void set_forgotten(bool forgotten) { forgotten_.store(forgotten, std::memory_order_release); }
  bool under_way() const { return stage() != CommandStage::kFree && !ended(); }

 private:
  struct End final : rt::Message {
    explicit End(Order& its_order) : rt::Message(&deliver), order(its_order) {}
    static void deliver(rt::Message& message) {
      const End& end = static_cast<End&>(message);
      Order& order = end.order;
      if (!order.is_forgotten()) order.caller_.tell(end.stage, end.reason);
      order.release();
    }
    Order& order;
    CommandStage stage = CommandStage::kFree;
    Reason reason;
  };

  bool is_called_off() const override { return cancel_requested() || caller_.rests(); }
  bool is_forgotten() const { return forgotten_.load(std::memory_order_acquire); }
  /// Whoever forgot it may be gone.
  void ending(CommandStage stage, const Reason& reason) override {
    if (is_forgotten()) return;
    end_.stage = stage;
    end_.reason = reason;
    share_once_more();
    Host::context(caller_.owner()).post(end_);
  }

  UntypedCommandCaller& caller_;
  std::atomic<bool> forgotten_{false};
  End end_{*this};
};

void UntypedCommandCaller::LetGo::operator()(Order* order) const { order->release(); }

UntypedCommandCaller::UntypedCommandCaller(Component& owner, std::string_view name,
                                           std::string_view doc, const CommandBase& like,
                                           std::size_t most, Ended ended, void* self) noexcept
    : CommandCallerBase(owner, name, doc, like.signature()),
      most_(most),
      ended_(ended),
      self_(self) {
  apply(Outstanding{0});  // it has orders
}

UntypedCommandCaller::~UntypedCommandCaller() = default;

void UntypedCommandCaller::prepare(const void* const* sample) {
  orders_.clear();
  if (target() == nullptr) return;
  for (std::size_t i = 0; i < most_; ++i) {
    orders_.emplace_back(new Order(*this, static_cast<CommandBase&>(*target())));
    orders_.back()->set_arguments(sample);
  }
}

CallStatus UntypedCommandCaller::send(const void* const* arguments) {
  if (target() == nullptr) return CallStatus::kNotConnected;
  for (const auto& order : orders_) {
    if (!order->try_claim()) continue;
    order->set_forgotten(false);
    order->set_arguments(arguments);
    Host::context(target()->owner()).post(*order);
    order->release();  // nobody holds on to it
    return CallStatus::kPending;
  }
  count_refused();
  return CallStatus::kQueueFull;
}

void UntypedCommandCaller::forget() {
  for (const auto& order : orders_) order->set_forgotten(true);
}

void UntypedCommandCaller::rest() {
  rests_.store(true, std::memory_order_release);
  for (const auto& order : orders_) {
    if (order->under_way()) order->request_cancel();
  }
}

void UntypedCommandCaller::tell(CommandStage stage, std::string_view reason) {
  Host::run_handler(owner(), Host::context(owner()), [&] { ended_(self_, stage, reason); });
}

/// A call on its way there, and its answer on the way back.
class UntypedOperationCaller::Question final : public rt::Message, public SharedRecord {
 public:
  Question(UntypedOperationCaller& caller, OperationBase& operation)
      : rt::Message(&Question::deliver),
        caller_(caller),
        operation_(operation),
        arguments_(operation.signature()) {}

  void set_arguments(const void* const* arguments) { arguments_.assign(arguments); }
  void set_forgotten(bool forgotten) { forgotten_.store(forgotten, std::memory_order_release); }

 private:
  struct Answer final : rt::Message {
    explicit Answer(Question& its_question)
        : rt::Message(&Answer::deliver), question(its_question) {}
    static void deliver(rt::Message& message) {
      const auto& answer = static_cast<Answer&>(message);
      Question& question = answer.question;
      if (!question.is_forgotten()) question.tell(answer.status);
      question.release();
    }
    Question& question;
    CallStatus status = CallStatus::kPending;
  };

  static void deliver(rt::Message& message) {
    auto& question = static_cast<Question&>(message);
    if (question.is_forgotten()) return question.release();
    Arguments& arguments = question.arguments_;
    question.answer_.status =
        question.operation_.execute_by_message(arguments.places(), arguments.result());
    // Whoever forgot it meanwhile may be gone.
    if (question.is_forgotten()) return question.release();
    Host::context(question.caller_.owner()).post(question.answer_);
  }
  void tell(CallStatus status) {
    Component& owner = caller_.owner();
    Host::run_handler(owner, Host::context(owner),
                      [&] { caller_.ended_(caller_.self_, status, arguments_.result()); });
  }
  bool is_forgotten() const { return forgotten_.load(std::memory_order_acquire); }

  using Arguments = internal::Arguments;
  UntypedOperationCaller& caller_;
  OperationBase& operation_;
  Arguments arguments_;
  std::atomic<bool> forgotten_{false};
  Answer answer_{*this};
};

void UntypedOperationCaller::LetGo::operator()(Question* question) const { question->release(); }

UntypedOperationCaller::UntypedOperationCaller(Component& owner, std::string_view name,
                                               std::string_view doc, const OperationBase& like,
                                               std::size_t most, Ended ended, void* self) noexcept
    : OperationCallerBase(owner, name, doc, like.signature()),
      most_(most),
      ended_(ended),
      self_(self) {
  apply(Outstanding{0});  // it has questions
}

UntypedOperationCaller::~UntypedOperationCaller() = default;

void UntypedOperationCaller::prepare(const void* const* sample) {
  questions_.clear();
  if (target() == nullptr) return;
  for (std::size_t i = 0; i < most_; ++i) {
    questions_.emplace_back(new Question(*this, *target()));
    questions_.back()->set_arguments(sample);
  }
}

CallStatus UntypedOperationCaller::send(const void* const* arguments) {
  if (target() == nullptr) return CallStatus::kNotConnected;
  for (const auto& question : questions_) {
    if (!question->try_share()) continue;
    question->set_forgotten(false);
    question->set_arguments(arguments);
    Host::context(target()->owner()).post(*question);
    question->release();  // nobody holds on to it
    return CallStatus::kPending;
  }
  count_refused();
  return CallStatus::kQueueFull;
}

void UntypedOperationCaller::forget() {
  for (const auto& question : questions_) question->set_forgotten(true);
}

UntypedInputPort::UntypedInputPort(Component& owner, std::string_view name, std::string_view doc,
                                   const OutputPortBase& like) noexcept
    : InputPortBase(owner, {name, doc, {}, like.type(), internal::is_small_type(like.type())}) {
  follow_unit_of(like);
}

}  // namespace armature::component
