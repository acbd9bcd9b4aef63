// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/connections.hpp"

#include "armature/component/interface.hpp"

namespace armature::inspect {
namespace {

template <typename Member>
std::string end_at(const Member& member) {
  return member.owner().name() + "." + std::string(member.name());
}

}  // namespace

std::vector<Connection> connections_of(
    const exec::Plan& plan, const std::function<bool(const std::string& component)>& which) {
  std::vector<Connection> all;
  const auto crosses = [&](exec::Index from, exec::Index to) {
    return plan.thread_of[from] != plan.thread_of[to];
  };
  const auto both = [&](const auto& from, const auto& to) {
    return which(from.owner().name()) && which(to.owner().name());
  };
  for (const exec::ConnectionPlan& one : plan.connections) {
    if (!both(*one.output, *one.input)) continue;
    all.push_back({"data", end_at(*one.output), end_at(*one.input), one.triggers, one.delayed,
                   crosses(one.from, one.to)});
  }
  for (const exec::SubscriptionPlan& one : plan.subscriptions) {
    if (!both(*one.event, *one.handler)) continue;
    all.push_back({"event", end_at(*one.event), end_at(*one.handler), false, false,
                   crosses(one.from, one.to)});
  }
  for (const exec::CallPlan& one : plan.calls) {
    if (!both(*one.requirement, *one.operation)) continue;
    all.push_back({one.operation->is_command() ? "command" : "operation", end_at(*one.requirement),
                   end_at(*one.operation), false, false, crosses(one.caller, one.callee)});
  }
  return all;
}

std::string component_of_end(const std::string& end) { return end.substr(0, end.rfind('.')); }

}  // namespace armature::inspect
