// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/order_in_cycle.hpp"

#include <algorithm>
#include <map>

namespace armature::replay {

using exec::ConnectionPlan;
using exec::Index;
using exec::Plan;

namespace {

bool in_one_thread(const Plan& plan, Index a, Index b) {
  return plan.thread_of[a] == plan.thread_of[b];
}

bool is_less_urgent(const Plan& plan, Index a, Index b) {
  return exec::urgency(plan.threads[plan.thread_of[a]].activity) <
         exec::urgency(plan.threads[plan.thread_of[b]].activity);
}

bool is_triggered_by_less_urgent(const Plan& plan, Index component) {
  return std::ranges::any_of(plan.connections,
                             [&](const ConnectionPlan& one) {
                               return one.triggers && one.to == component &&
                                      is_less_urgent(plan, one.from, component);
                             }) ||
         std::ranges::any_of(plan.subscriptions, [&](const exec::SubscriptionPlan& one) {
           return one.to == component && is_less_urgent(plan, one.from, component);
         });
}

bool is_read_in_its_thread_alone(const Plan& plan, const component::OutputPortBase& output) {
  return std::ranges::all_of(plan.connections, [&](const ConnectionPlan& one) {
    return one.output != &output || in_one_thread(plan, one.from, one.to);
  });
}

}  // namespace

std::set<const exec::ConnectionEntry*> ways_back(const Plan& plan,
                                                 const std::function<bool(Index)>& is_recorded) {
  std::map<Index, std::size_t> place;
  for (const exec::ThreadPlan& thread : plan.threads) {
    for (std::size_t k = 0; k < thread.members.size(); ++k) place[thread.members[k]] = k;
  }
  std::set<const exec::ConnectionEntry*> back;
  for (const ConnectionPlan& one : plan.connections) {
    const bool onward = in_one_thread(plan, one.from, one.to) && place[one.from] < place[one.to];
    if (is_recorded(one.to) && !onward) back.insert(one.entry);
  }
  return back;
}

bool writes_behind_cycle(const Plan& plan, Index component,
                         const component::OutputPortBase& output) {
  return is_triggered_by_less_urgent(plan, component) && is_read_in_its_thread_alone(plan, output);
}

}  // namespace armature::replay
