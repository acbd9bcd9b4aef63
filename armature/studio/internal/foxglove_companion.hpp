// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "armature/foxglove/server.hpp"
#include "workbench_client.hpp"

namespace armature::studio::internal {

/// What a client of Foxglove has of the workbench: descriptions of robots and what moves them. It
/// is known as a guest, to whom the operator's seat can be handed over.
class FoxgloveCompanion final : public foxglove::Companion {
 public:
  explicit FoxgloveCompanion(ride::Peer& peer);

  base::Result<std::string> description(const std::string& path) override;
  std::map<std::string, std::string> chosen_ports() override;
  void attend() override;

 private:
  WorkbenchPlaceholder workbench_;
  bool may_look_ = true;
};

/// The server of Foxglove's protocol for what a studio runs.
foxglove::ServerOptions foxglove_options();

}  // namespace armature::studio::internal
