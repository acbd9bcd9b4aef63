// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operation.hpp"

#include "armature/component/command.hpp"

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
  }
  return "unknown";
}

std::string_view name_of(CommandStage stage) {
  switch (stage) {
    case CommandStage::kFree:
      return "free";
    case CommandStage::kQueued:
      return "queued";
    case CommandStage::kAccepted:
      return "under way";
    case CommandStage::kRefused:
      return "refused";
    case CommandStage::kDone:
      return "done";
    case CommandStage::kFailed:
      return "failed";
    case CommandStage::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

std::string OperationBase::mismatch(const std::vector<types::Value>& arguments) const {
  bool fits = arguments.size() == about_->signature.arguments.size();
  for (std::size_t i = 0; fits && i < arguments.size(); ++i) {
    fits = types::same_type(arguments[i].type(), *about_->signature.arguments[i].type);
  }
  if (fits) return {};
  std::string given;
  for (const types::Value& argument : arguments) {
    given += (given.empty() ? "" : ", ") + argument.type().name;
  }
  return "'" + owner_.name() + "." + std::string(name()) + "' is " + about_->signature.text() +
         "; it was called with (" + given + ")";
}

}  // namespace armature::component
