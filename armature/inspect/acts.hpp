// SPDX-License-Identifier: Apache-2.0
#pragma once

// What tools do with a running application, by values of its types. Texts and what Lua has become
// such values first: a View reads texts, Lua its own. Errors name what they are about.
// @thread the controlling one, as for all functions that take an application

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application.hpp"
#include "armature/inspect/items.hpp"
#include "armature/inspect/status.hpp"
#include "armature/types/type.hpp"

namespace armature::inspect {

/// Sets a property, in its component's thread, or writes an input that is open to the operator.
/// @param member  one that `check_settable` lets through
base::Result<void> set(exec::Application& application, const Member& member,
                       const types::Value& value, exec::Caller caller);

/// Why the port `member` cannot be written by `caller` whatever the value. Of an event or operation
/// there is more to say.
base::Result<void> check_settable(const exec::Application& application, const Member& member,
                                  exec::Caller caller);

/// Calls an operation, or begins a command, and waits for the answer.
/// @return what the operation gives
base::Result<std::optional<types::Value>> call(exec::Application& application,
                                               const Member& operation,
                                               std::vector<types::Value> arguments,
                                               exec::Caller caller);

/// Begins a command and waits until it is accepted.
base::Result<component::CommandHandle> begin(exec::Application& application, const Member& command,
                                             std::vector<types::Value> arguments,
                                             exec::Caller caller);

/// What is wrong with so many arguments.
base::Result<void> check_count(const Member& operation, std::size_t arguments);

/// `Axis.sum: argument 1 (values)`; counted from 0.
std::string argument_name(const Member& operation, std::size_t argument);

/// How a command fares.
CommandStatus status_of(std::string name, const component::CommandHandle& command);

/// `error` behind `name`, unless it names its object itself, in quotes at its beginning.
std::string with_name(const std::string& name, const std::string& error);

}  // namespace armature::inspect
