// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/blueprint.hpp"

#include <utility>

#include "armature/exec/modes.hpp"

namespace armature::exec {
namespace {

std::pair<std::string, std::string> split(std::string_view reference) {
  const std::size_t dot = reference.rfind('.');
  if (dot == std::string_view::npos) return {std::string(reference), {}};
  return {std::string(reference.substr(0, dot)), std::string(reference.substr(dot + 1))};
}

}  // namespace

void Blueprint::connect(std::string_view from, std::string_view to,
                        component::ConnectionPolicy policy) {
  auto [from_component, from_port] = split(from);
  auto [to_component, to_port] = split(to);
  connections.push_back({std::move(from_component),
                         std::move(from_port),
                         std::move(to_component),
                         std::move(to_port),
                         policy,
                         {},
                         {},
                         {}});
}

void Blueprint::add_peer(std::string_view user, std::string_view used) {
  for (ComponentEntry& entry : components) {
    if (entry.component->name() == user) entry.peers.push_back({std::string(used), {}});
  }
}

void Blueprint::add_mode(std::string mode_name, std::vector<ModeMember> members,
                         base::Location where) {
  if (modes.empty()) {
    components.push_back({std::make_unique<Modes>(kModesName), {}, {}, {}, {}, where});
  }
  modes.push_back({std::move(mode_name), std::move(members), std::move(where)});
}

}  // namespace armature::exec
