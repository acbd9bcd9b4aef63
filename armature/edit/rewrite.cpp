// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/rewrite.hpp"

#include <algorithm>
#include <utility>

#include "armature/document/fields.hpp"

namespace armature::edit::internal {
namespace {

using document::Connection;
using document::Document;

/// A peer that is known by its component's name, without the composites around it, is known by the
/// new one.
void rename_peer(document::Peer& peer, const NewName& new_name) {
  const std::string old = std::exchange(peer.component, new_name(peer.component));
  const bool by_component = old == peer.name || old.ends_with("." + peer.name);
  const bool same = peer.component == peer.name || peer.component.ends_with("." + peer.name);
  if (!by_component || same) return;
  peer.name = peer.component.substr(old.size() - peer.name.size());
}

void rename_parameters(std::vector<document::Property>& with, const NewName& new_name) {
  for (document::Property& parameter : with) {
    document::Value& value = parameter.value;
    if (value.kind != document::Value::Kind::kText || value.literal) continue;
    auto [component, port] = document::split_last_dot(value.text);
    if (!component.empty()) value.text = new_name(component) + "." + port;
  }
}

void rename_connection(Connection& connection, const NewName& new_name) {
  connection.from.component = new_name(connection.from.component);
  connection.to.component = new_name(connection.to.component);
  if (!connection.name.empty()) connection.name = new_name(connection.name);
  rename_parameters(connection.with, new_name);
}

void rename_call(document::Call& call, const NewName& new_name) {
  call.to.component = new_name(call.to.component);
  rename_parameters(call.with, new_name);
}

void rename_operations(std::vector<document::OperationOf>& operations, const NewName& new_name) {
  for (auto& one : operations) one.component = new_name(one.component);
}

bool uses_gone(const std::vector<document::Property>& with, const IsGone& is_gone) {
  return std::any_of(with.begin(), with.end(), [&](const document::Property& parameter) {
    return is_gone(document::split_last_dot(parameter.value.text).first);
  });
}

bool refers_to(const Connection& connection, const IsGone& is_gone) {
  return is_gone(connection.from.component) || is_gone(connection.to.component) ||
         uses_gone(connection.with, is_gone);
}

template <typename List>
void erase_gone(List& list, const IsGone& is_gone) {
  std::erase_if(list, [&](const auto& one) { return is_gone(one.component); });
}

void erase_gone(std::vector<document::Reference>& list, const IsGone& is_gone) {
  std::erase_if(list, [&](const auto& one) { return is_gone(one.name); });
}

}  // namespace

Document renamed(Document document, const NewName& new_name) {
  for (auto& component : document.components) {
    component.name = new_name(component.name);
    for (auto& peer : component.peers) rename_peer(peer, new_name);
    for (auto& binding : component.bindings) binding.component = new_name(binding.component);
    for (auto& call : component.calls) rename_call(call, new_name);
    for (auto& delay : component.delays) delay.name = new_name(delay.name);
  }
  for (auto& connection : document.connections) rename_connection(connection, new_name);
  for (auto& named : document.named_connections) {
    for (auto& port : named.ports) port.component = new_name(port.component);
  }
  for (auto& composite : document.composites) {
    composite.name = new_name(composite.name);
    for (auto& one : composite.exports) one.component = new_name(one.component);
  }
  for (auto* operations :
       {&document.script_grants, &document.remote_grants, &document.before_stop}) {
    rename_operations(*operations, new_name);
  }
  for (auto* inputs : {&document.operator_inputs, &document.network.inputs}) {
    for (Connection& input : *inputs) rename_connection(input, new_name);
  }
  for (auto& mode : document.modes) {
    for (auto& component : mode.components) component.name = new_name(component.name);
  }
  return document;
}

Document without(Document document, const IsGone& is_gone) {
  std::erase_if(document.components, [&](const auto& one) { return is_gone(one.name); });
  std::erase_if(document.composites, [&](const auto& one) { return is_gone(one.name); });
  for (auto& component : document.components) {
    erase_gone(component.peers, is_gone);
    erase_gone(component.bindings, is_gone);
    std::erase_if(component.calls, [&](const document::Call& call) {
      return is_gone(call.to.component) || uses_gone(call.with, is_gone);
    });
    erase_gone(component.delays, is_gone);
  }
  for (auto& composite : document.composites) erase_gone(composite.exports, is_gone);
  for (auto* connections :
       {&document.connections, &document.operator_inputs, &document.network.inputs}) {
    std::erase_if(*connections, [&](const auto& one) { return refers_to(one, is_gone); });
  }
  for (auto& named : document.named_connections) erase_gone(named.ports, is_gone);
  std::erase_if(document.named_connections, [](const auto& one) { return one.ports.empty(); });
  erase_gone(document.script_grants, is_gone);
  erase_gone(document.remote_grants, is_gone);
  erase_gone(document.before_stop, is_gone);
  for (auto& mode : document.modes) erase_gone(mode.components, is_gone);
  std::erase_if(document.modes, [](const auto& mode) { return mode.components.empty(); });
  return document;
}

}  // namespace armature::edit::internal
