// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/acts.hpp"

#include <utility>

#include "armature/exec/inlets.hpp"

namespace armature::inspect {
namespace {

std::string plain_name(const Member& operation) {
  return operation.component->name() + "." + std::string(operation.operation->name());
}

}  // namespace

base::Result<void> set(exec::Application& application, const Member& member,
                       const types::Value& value, exec::Caller caller) {
  if (member.input != nullptr) {
    return exec::write_for_operator(application, *member.input, value);
  }
  return application.set_property(member.component->name(), member.property->name(), value, caller);
}

base::Result<void> check_settable(const exec::Application& application, const Member& member,
                                  exec::Caller caller) {
  if (member.port() == nullptr) return {};
  const bool open =
      member.input != nullptr && exec::is_open_to_operator(application, *member.input);
  if (!open) return base::Error{"'" + member.name() + "' is a port: only components write it"};
  if (caller == exec::Caller::kOperator) return {};
  return base::Error{"'" + member.name() +
                     "' is an input of the operator: only the operator writes it"};
}

base::Result<std::optional<types::Value>> call(exec::Application& application,
                                               const Member& operation,
                                               std::vector<types::Value> arguments,
                                               exec::Caller caller) {
  auto answer = application.call(operation.component->name(), operation.operation->name(),
                                 std::move(arguments), caller);
  if (!answer) return base::Error{with_name(plain_name(operation), answer.error())};
  return answer;
}

base::Result<component::CommandHandle> begin(exec::Application& application, const Member& command,
                                             std::vector<types::Value> arguments,
                                             exec::Caller caller) {
  auto begun = application.begin(command.component->name(), command.operation->name(),
                                 std::move(arguments), caller);
  if (!begun) return base::Error{with_name(plain_name(command), begun.error())};
  return begun;
}

base::Result<void> check_count(const Member& operation, std::size_t arguments) {
  const component::Signature& signature = operation.operation->signature();
  const std::size_t wanted = signature.arguments.size();
  if (arguments == wanted) return {};
  return base::Error{plain_name(operation) + " takes " + std::to_string(wanted) +
                     (wanted == 1 ? " argument" : " arguments") + ", not " +
                     std::to_string(arguments) + ": it is " + signature.text()};
}

std::string argument_name(const Member& operation, std::size_t argument) {
  const auto& described = operation.operation->signature().arguments[argument];
  const std::string label = described.name.empty() ? "" : " (" + std::string(described.name) + ")";
  return plain_name(operation) + ": argument " + std::to_string(argument + 1) + label;
}

CommandStatus status_of(std::string name, const component::CommandHandle& command) {
  CommandStatus status;
  status.name = std::move(name);
  status.stage = command.stage();
  status.ended = command.ended();
  status.progress = command.progress();
  const bool failed = status.ended && status.stage != component::CommandStage::kDone;
  if (failed) status.reason = command.reason();
  return status;
}

std::string with_name(const std::string& name, const std::string& error) {
  return error.starts_with('\'') ? error : name + ": " + error;
}

}  // namespace armature::inspect
