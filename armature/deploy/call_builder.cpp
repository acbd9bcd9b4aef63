// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/call_builder.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"

namespace armature::deploy::internal {

CallBuilder::CallBuilder(const Document& document, exec::Blueprint& blueprint,
                         base::Diagnostics& diagnostics)
    : document_(document), blueprint_(blueprint), diagnostics_(diagnostics) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    components_.emplace(entry.component->name(), entry.component.get());
  }
}

void CallBuilder::build() {
  std::unordered_map<std::string_view, const Component*> written;
  for (const Component& one : document_.components) written.emplace(one.name, &one);
  for (exec::ComponentEntry& entry : blueprint_.components) {
    const auto found = written.find(entry.component->name());
    if (found != written.end()) add(*found->second, entry);
  }
}

void CallBuilder::add(const Component& written, exec::ComponentEntry& entry) {
  auto* const caller = dynamic_cast<component::CallsByName*>(entry.component.get());
  if (!check_number(written, entry, caller) || caller == nullptr) return;
  std::vector<component::NamedCall> calls;
  bool complete = true;
  for (const Call& call : written.calls) {
    auto one = named(written, call, calls.size() + 1);
    complete = complete && one;
    if (one) calls.push_back(std::move(*one));
  }
  if (!complete) {
    blueprint_.absent.insert(written.name);  // what would have begun at it is not looked at
    return;
  }
  const bool keeps_running = document_.on_fault == OnFault::kKeepRunning;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Endpoint& to = written.calls[i].to;
    const auto same = [&](const exec::PeerEntry& peer) { return peer.name == to.component; };
    if (std::ranges::none_of(entry.peers, same)) entry.peers.push_back({to.component, to.where});
    entry.bindings.push_back({calls[i].caller, to.component, to.port, to.where});
    connect_parameters(calls[i].parameters, written.name, keeps_running, written.calls[i].where,
                       blueprint_);
  }
  const component::Outcome declared = caller->declare_calls(std::move(calls));
  if (declared) return;
  diagnostics_.error(written.calls.front().where,
                     in_quotes(written.name) + ": " + std::string(declared.reason()));
}

/// False if there is nothing to be done for it.
bool CallBuilder::check_number(const Component& written, const exec::ComponentEntry& entry,
                               const component::CallsByName* caller) {
  if (caller == nullptr) {
    if (written.calls.empty()) return false;
    diagnostics_.error(
        written.calls.front().where,
        in_quotes(written.name) + " (" + entry.model + ") does not take calls from a deployment",
        "calls belong to a Sequence or a Request");
    return false;
  }
  if (written.calls.empty()) {
    diagnostics_.error(written.where,
                       in_quotes(written.name) + " (" + entry.model + ") has no calls",
                       "for example calls: [Vision.start]");
    return false;
  }
  if (written.calls.size() <= caller->most_calls()) return true;
  diagnostics_.error(written.calls[caller->most_calls()].where,
                     in_quotes(written.name) + " (" + entry.model + ") makes " +
                         std::to_string(caller->most_calls()) + " call, found " +
                         std::to_string(written.calls.size()),
                     "a Sequence makes several, one after the other");
  return false;
}

const component::OperationBase* CallBuilder::operation_of(const Component& written,
                                                          const Call& call) {
  const Endpoint& to = call.to;
  const component::Component* const target =
      component_at(to, components_, blueprint_, diagnostics_);
  if (target == nullptr) return nullptr;
  if (to.component == written.name) {
    diagnostics_.error(to.where, in_quotes(written.name) + " calls itself",
                       "name an operation of another component");
    return nullptr;
  }
  std::vector<std::string> names;
  for (const auto* operation : component::interface_of(*target).operations) {
    names.emplace_back(operation->name());
    if (operation->name() != to.port) continue;
    if (operation->is_by_operator()) {
      diagnostics_.error(to.where,
                         path(to) + " is an act of the operator: no other component does it",
                         "do it at the prompt of the task browser, or in a script that it is "
                         "granted to");
      return nullptr;
    }
    if (operation->is_offered()) return operation;
    diagnostics_.error(to.where, operation->why_not_offered());
    return nullptr;
  }
  diagnostics_.error(to.where,
                     in_quotes(to.component) + " has no operation or command " + in_quotes(to.port),
                     base::suggestion(to.port, names));
  return nullptr;
}

std::optional<component::NamedCall> CallBuilder::named(const Component& written, const Call& call,
                                                       std::size_t index) {
  const component::OperationBase* const operation = operation_of(written, call);
  if (operation == nullptr) return std::nullopt;
  const std::string number = std::to_string(index);
  Called called{call.to, operation->signature(), call.with, call.where};
  if (written.calls.size() > 1) called.prefix = "Call" + number + "_";
  auto parameters = ParameterBuilder(components_, diagnostics_).parameters(called);
  if (!parameters) return std::nullopt;
  return component::NamedCall{"Call" + number, to_text(call.to), operation, std::move(*parameters)};
}

}  // namespace armature::deploy::internal
