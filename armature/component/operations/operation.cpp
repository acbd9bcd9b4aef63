// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operations/operation.hpp"

#include <utility>

#include "armature/component/described.hpp"
#include "armature/component/host.hpp"
#include "armature/component/internal/pending_call.hpp"
#include "armature/component/stand_in.hpp"

namespace armature::component {

struct OperationBase::About {
  std::string_view name;
  std::string_view doc;
  Signature signature;
  ExecuteFrom execute_from;
  FreeFunction function{};
  bool own_thread = false;
  bool by_operator = false;
  bool elsewhere = false;
  bool any_state = false;
  const Property<bool>* offered_if = nullptr;
};

OperationBase::OperationBase(Component& owner, std::string_view name, std::string_view doc,
                             Signature signature, ExecuteFrom execute_from) noexcept
    : owner_(owner), about_(new About{name, doc, std::move(signature), execute_from}) {
  Host::declare(owner).operations.push_back(this);
}

OperationBase::~OperationBase() = default;

std::string_view OperationBase::name() const { return about_->name; }

std::string_view OperationBase::doc() const { return about_->doc; }

const Signature& OperationBase::signature() const { return about_->signature; }

bool OperationBase::runs_in_own_thread() const { return about_->own_thread; }

bool OperationBase::is_by_operator() const { return about_->by_operator; }

bool OperationBase::is_elsewhere() const { return about_->elsewhere; }

bool OperationBase::serves_in_any_state() const { return about_->any_state; }

bool OperationBase::serves_unready() const { return about_->any_state && owner_.is_configured(); }

void OperationBase::apply(InOwnThread) noexcept { about_->own_thread = true; }

void OperationBase::apply(ByOperator) noexcept { about_->by_operator = true; }

void OperationBase::apply(InAnyState) noexcept { about_->any_state = true; }

void OperationBase::apply(Wanted option) noexcept { about_->offered_if = option.property; }

bool OperationBase::is_offered() const {
  return about_->offered_if == nullptr || about_->offered_if->get();
}

void OperationBase::apply(const ArgumentNames& given) noexcept {
  std::vector<Signature::Argument>& arguments = about_->signature.arguments;
  for (std::size_t i = 0; i < arguments.size() && i < given.names.size(); ++i) {
    arguments[i].name = given.names[i];
  }
}

void OperationBase::set_free_function(FreeFunction function) noexcept {
  about_->function = function;
}

FreeFunction OperationBase::free_function() const noexcept { return about_->function; }

CallStatus OperationBase::execute_by_message(const void* const* arguments, void* result) noexcept {
  CallStatus status = CallStatus::kPending;
  Host::run(owner_, Host::context(owner_), [&] {
    status = about_->execute_from(*this, Host::context(owner_), arguments, result);
  });
  return status;
}

CallStatus OperationBase::execute_here(ExecutionContext& where, const void* const* arguments,
                                       void* result) noexcept {
  return about_->execute_from(*this, where, arguments, result);
}

base::Result<std::optional<types::Value>> OperationBase::invoke(
    const std::vector<types::Value>& arguments) {
  if (std::string problem = mismatch(arguments); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  std::vector<const void*> places;
  for (const types::Value& argument : arguments) places.push_back(argument.data());
  std::optional<types::Value> result;
  if (signature().result != nullptr) result.emplace(*signature().result);
  const CallStatus status = execute_by_message(places.data(), result ? result->data() : nullptr);
  if (status == CallStatus::kDone) return result;
  return base::Error{std::string(name()) + ": " + std::string(name_of(status)) + ": " +
                     std::string(owner().reason())};
}

std::unique_ptr<OperationBase> OperationBase::twin(StandIn& owner) const {
  std::unique_ptr<OperationBase> made = make_twin(owner);
  About& its = *made->about_;
  its.signature = about_->signature;
  its.own_thread = true;
  its.by_operator = about_->by_operator;
  its.any_state = about_->any_state;
  its.elsewhere = true;
  return made;
}

CallStatus OperationBase::pass_on(ExecutionContext& where, const void* const* arguments,
                                  void* result) noexcept {
  if (where.real_time) return CallStatus::kWouldWait;
  auto& component = static_cast<StandIn&>(owner());
  if (!component.ready()) return CallStatus::kNotReady;
  CallStatus status = CallStatus::kFailed;
  Host::enter_hook(component, where, [&] { status = component.call(*this, arguments, result); });
  return status;
}

std::string OperationBase::mismatch(const std::vector<types::Value>& arguments) const {
  bool fits = arguments.size() == about_->signature.arguments.size();
  for (std::size_t i = 0; fits && i < arguments.size(); ++i) {
    fits = types::same_type(arguments[i].type(), *about_->signature.arguments[i].type);
  }
  if (!is_offered()) return why_not_offered();
  if (fits) return refusal_of_sealed();
  std::string given;
  for (const types::Value& argument : arguments) {
    given += (given.empty() ? "" : ", ") + argument.type().name;
  }
  return "'" + owner_.name() + "." + std::string(name()) + "' is " + about_->signature.text() +
         "; it was called with (" + given + ")";
}

std::string OperationBase::refusal_of_sealed() const {
  for (const Signature::Argument& argument : about_->signature.arguments) {
    if (!argument.type->sealed) continue;
    return "'" + owner_.name() + "." + std::string(name()) + "' takes a " + argument.type->name +
           ", which only components make: a tool cannot call it";
  }
  return {};
}

std::string OperationBase::why_not_offered() const {
  return "'" + owner_.name() + "' has no operation '" + std::string(name()) + "': its property " +
         std::string(about_->offered_if->name()) + " is false";
}

struct OperationCallerBase::About final : Requirement::About {
  About(std::string_view its_name, std::string_view its_doc, Signature its_signature)
      : Requirement::About(its_name, its_doc), signature(std::move(its_signature)) {}

  Signature signature;
  std::uint64_t refused = 0;
  std::size_t outstanding = kDefaultOutstanding;
  std::vector<std::unique_ptr<internal::PendingCall, SharedRecord::LetGo>> calls;
  std::size_t next = 0;
};

OperationCallerBase::OperationCallerBase(Component& owner, std::string_view name,
                                         std::string_view doc, Signature signature) noexcept
    : Requirement(owner, std::make_unique<About>(name, doc, std::move(signature))) {
  Host::declare(owner).callers.push_back(this);
}

OperationCallerBase::~OperationCallerBase() = default;

OperationCallerBase::About& OperationCallerBase::about() const {
  return static_cast<About&>(Requirement::about());
}

const Signature& OperationCallerBase::signature() const { return about().signature; }

std::uint64_t OperationCallerBase::refused() const { return about().refused; }

void OperationCallerBase::count_refused() { ++about().refused; }

void OperationCallerBase::apply(Outstanding option) noexcept { about().outstanding = option.count; }

std::size_t OperationCallerBase::outstanding() const { return about().outstanding; }

bool OperationCallerBase::would_wait() const {
  return Host::context(owner()).real_time && operation_->is_elsewhere();
}

bool OperationCallerBase::calls_described() const {
  return described_ &&
         Host::context(operation_->owner()).shares_thread_with(Host::context(owner()));
}

CallStatus OperationCallerBase::call_described(const void* const* arguments, void* result) {
  CallStatus status = CallStatus::kFailed;
  Host::call_out(owner(), operation_->owner(), [&] {
    status = operation_->execute_here(Host::context(owner()), arguments, result);
  });
  return status;
}

void OperationCallerBase::connect(OperationBase& operation) {
  operation_ = &operation;
  described_ = dynamic_cast<DescribedOperation*>(&operation) != nullptr;
  direct_ = !described_ && (!operation.runs_in_own_thread() ||
                            &Host::context(operation.owner()) == &Host::context(owner()));
  About& mine = about();
  mine.calls.clear();
  mine.next = 0;
  for (std::size_t i = 0; i < mine.outstanding; ++i) {
    mine.calls.emplace_back(new internal::PendingCall(operation));
  }
}

void OperationCallerBase::disconnect() {
  operation_ = nullptr;
  about().calls.clear();
}

SentCall OperationCallerBase::send_from(const void* const* arguments) {
  if (operation_ == nullptr) return SentCall(CallStatus::kNotConnected);
  About& mine = about();
  for (std::size_t tried = 0; tried < mine.calls.size(); ++tried) {
    internal::PendingCall& call = *mine.calls[mine.next];
    if (++mine.next == mine.calls.size()) mine.next = 0;
    if (!call.try_claim()) continue;
    call.set_arguments(arguments);
    Host::context(operation_->owner()).post(call);
    return SentCall(call);
  }
  ++mine.refused;
  return SentCall(CallStatus::kQueueFull);
}

void OperationCallerBase::prepare_from(const void* const* arguments) {
  for (auto& call : about().calls) call->set_arguments(arguments);
}

}  // namespace armature::component
