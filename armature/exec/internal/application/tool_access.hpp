// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/exec/application_options.hpp"
#include "armature/exec/internal/application/executor.hpp"
#include "armature/exec/internal/application/roster.hpp"
#include "armature/exec/internal/application/ticket_pool.hpp"

namespace armature::exec::internal {

/// What tools read, set, call and begin; each is done by the component's own thread, and what is
/// the operator's only for who is or has a grant.
class ToolAccess {
 public:
  ToolAccess(const Roster& roster, const Executor& executor, TicketPool& tickets,
             const std::vector<Grant>& grants)
      : roster_(roster), executor_(executor), tickets_(tickets), grants_(grants) {}

  base::Result<void> set_property(std::string_view component, std::string_view property,
                                  const types::Value& value, Caller caller) const;
  base::Result<types::Value> value_of(std::string_view component, std::string_view item) const;
  base::Result<std::optional<types::Value>> call(std::string_view component,
                                                 std::string_view operation,
                                                 std::vector<types::Value> arguments,
                                                 Caller caller) const;
  /// @param number  of the act; 0: nobody keeps account of acts
  base::Result<component::CommandHandle> begin(std::string_view component, std::string_view command,
                                               std::vector<types::Value> arguments, Caller caller,
                                               std::uint32_t number = 0) const;

 private:
  /// An error that says why not if `caller` may not do this act of the operator.
  base::Result<void> granted(const component::Component& component, std::string_view act,
                             Caller caller) const;
  /// What a tool may call on behalf of `caller`, or why it may not.
  base::Result<component::OperationBase*> operation_for(std::string_view component,
                                                        std::string_view operation,
                                                        Caller caller) const;
  base::Result<types::Value> value_of(component::Component& component, const types::Type& type,
                                      std::function<const void*()> data) const;

  const Roster& roster_;
  const Executor& executor_;
  TicketPool& tickets_;
  const std::vector<Grant>& grants_;
};

}  // namespace armature::exec::internal
