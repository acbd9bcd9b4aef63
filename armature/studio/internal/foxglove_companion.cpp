// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/foxglove_companion.hpp"

#include <nlohmann/json.hpp>

#include "armature/studio/internal/entrance.hpp"
#include "armature/studio/internal/operators_bench.hpp"

namespace armature::studio::internal {
namespace {

using namespace std::chrono_literals;

/// A desk that has more to do answers later, and is asked again.
constexpr ride::CallOptions kBrief{.deadline = 2s, .priority = {}};

}  // namespace

FoxgloveCompanion::FoxgloveCompanion(ride::Peer& peer) : workbench_(peer, OperatorsBench::kName) {}

base::Result<std::string> FoxgloveCompanion::description(const std::string& path) {
  auto answer = workbench_.description(path, kBrief);
  if (!answer.ok()) return base::Error{answer.error()};
  return std::move(answer.value());
}

std::map<std::string, std::string> FoxgloveCompanion::chosen_ports() {
  std::map<std::string, std::string> ports;
  const auto answer = workbench_.places(kBrief);
  if (!answer.ok()) return ports;
  const auto places = nlohmann::json::parse(answer.value(), nullptr, false);
  const auto robots = places.is_object() ? places.find("robots") : places.end();
  if (!places.is_object() || robots == places.end() || !robots->is_object()) return ports;
  for (const auto& [robot, port] : robots->items()) {
    if (port.is_string()) ports[robot] = port.get<std::string>();
  }
  return ports;
}

void FoxgloveCompanion::attend() {
  if (!may_look_) return;  // each refusal would be logged
  may_look_ = workbench_.seat(kBrief).code() != ride::Code::kNotAllowed;
}

foxglove::ServerOptions foxglove_options() {
  return {.inspector = kRunName,
          .companion = [](ride::Peer& peer) { return std::make_unique<FoxgloveCompanion>(peer); }};
}

}  // namespace armature::studio::internal
