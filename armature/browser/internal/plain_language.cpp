// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/plain_language.hpp"

#include <algorithm>

#include "armature/base/near_name.hpp"
#include "armature/browser/internal/plain_values.hpp"

namespace armature::browser::internal {

bool PlainLanguage::is_statement(std::string_view line) const {
  return is_call(line) || !Assignment(line).target.empty();
}

void PlainLanguage::take(std::string_view line) {
  if (is_call(line)) return take_call(line);
  const Assignment assignment(line);
  if (!assignment.target.empty()) return take_assignment(assignment);
  explain(std::string(line));
}

void PlainLanguage::take_call(std::string_view line) {
  const base::Result<TypedCall> typed = parse_call(line);
  if (!typed) return answers_.mistake(typed.error());
  const TypedCall& call = typed.value();
  const std::string component = robot_.find(call.component);
  if (component.empty()) return answers_.mistake(no_component(robot_, call.component));
  const remote::ComponentDetails details = robot_.interface_of(component);
  const auto operation =
      std::ranges::find(details.operations, call.operation, &remote::OperationDetails::name);
  if (operation == details.operations.end()) {
    const auto member = member_in(robot_, component + ":" + call.operation);
    return answers_.mistake(
        member ? "'" + component + "." + call.operation + "' is not an operation" : member.error());
  }
  if (operation->command) return session_.begin(component, call.operation, call.arguments);
  const std::string result = robot_.call(component, call.operation, call.arguments);
  if (!result.empty()) answers_.say(result);
}

void PlainLanguage::take_assignment(const Assignment& assignment) {
  const base::Result<std::string> value = as_in_files(assignment.value);
  if (!value) return answers_.mistake(assignment.target + ": " + value.error());
  const remote::ItemValue now = robot_.write(assignment.target, value.value());
  answers_.say(assignment.target + " = " + with_unit(now.value, now.unit));
}

/// Why a line is neither a command nor anything else.
void PlainLanguage::explain(const std::string& line) {
  const auto member = member_in(robot_, line);
  if (member) return answers_.mistake(robot_.read({line}, kAskedElements).at(0).error);
  if (line.find_first_of(".:") != std::string::npos) return answers_.mistake(member.error());
  std::vector<std::string> known = robot_.component_names();
  for (const Topic& topic : vocabulary().commands) known.emplace_back(topic.name);
  const std::string near = base::near_name(line, known);
  answers_.mistake("unknown command or component '" + line + "'" +
                   (near.empty() ? "" : " (did you mean '" + near + "'?)"));
}

}  // namespace armature::browser::internal
