// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operation.hpp"

namespace armature::component {

std::string_view name_of(CallStatus status) {
  switch (status) {
    case CallStatus::kDone:
      return "done";
    case CallStatus::kPending:
      return "pending";
    case CallStatus::kNotConnected:
      return "not connected";
    case CallStatus::kNotReady:
      return "not ready";
    case CallStatus::kFailed:
      return "failed";
    case CallStatus::kCancelled:
      return "cancelled";
    case CallStatus::kQueueFull:
      return "queue full";
    case CallStatus::kTimeout:
      return "timeout";
    case CallStatus::kUnreachable:
      return "unreachable";
    case CallStatus::kWouldWait:
      return "would wait for another process";
  }
  return "unknown";
}

void OperationBase::mark_twin(OperationBase& twin) const {
  twin.about_->signature = about_->signature;
  twin.about_->own_thread = true;
  twin.about_->by_operator = about_->by_operator;
  twin.about_->any_state = about_->any_state;
  twin.about_->elsewhere = true;
}

OperationBase::About::About(std::string_view its_name, std::string_view its_doc,
                            Signature its_signature, bool its_own_thread)
    : name(its_name),
      doc(its_doc),
      signature(std::move(its_signature)),
      own_thread(its_own_thread) {}

OperationBase::About::~About() = default;

OperationBase::OperationBase(Component& owner, std::unique_ptr<About> about) noexcept
    : owner_(owner), about_(std::move(about)) {
  owner.declare().operations.push_back(this);
}

OperationBase::~OperationBase() = default;

bool OperationBase::serves_unready() const { return about_->any_state && owner_.is_configured(); }

void OperationBase::apply(const ArgumentNames& given) noexcept {
  std::vector<Signature::Argument>& arguments = about_->signature.arguments;
  for (std::size_t i = 0; i < arguments.size() && i < given.names.size(); ++i) {
    arguments[i].name = given.names[i];
  }
}

base::Error OperationBase::failure(CallStatus status) const {
  return {std::string(name()) + ": " + std::string(name_of(status)) + ": " +
          std::string(owner().reason())};
}

OperationCallerBase::About::About(std::string_view its_name, std::string_view its_doc,
                                  Signature its_signature)
    : Requirement::About(its_name, its_doc), signature(std::move(its_signature)) {}

OperationCallerBase::About::~About() = default;

OperationCallerBase::OperationCallerBase(Component& owner, std::unique_ptr<About> about) noexcept
    : Requirement(owner, std::move(about)) {
  owner.declare().callers.push_back(this);
}

OperationCallerBase::~OperationCallerBase() = default;

std::string OperationBase::mismatch(const std::vector<types::Value>& arguments) const {
  bool fits = arguments.size() == about_->signature.arguments.size();
  for (std::size_t i = 0; fits && i < arguments.size(); ++i) {
    fits = types::same_type(arguments[i].type(), *about_->signature.arguments[i].type);
  }
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

}  // namespace armature::component
