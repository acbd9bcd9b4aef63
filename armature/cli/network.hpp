// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/cli/arguments.hpp"
#include "armature/cli/console.hpp"
#include "armature/deploy/builder.hpp"
#include "armature/foxglove/server.hpp"
#include "armature/remote/network.hpp"
#include "armature/websocket/transport.hpp"

namespace armature::cli {

/// The process's part in a network, made when something asks for it. It outlives the application.
class NetworkOnDemand {
 public:
  /// @param console  outlives this
  /// @param policy   a file with rules beside those of the deployment; empty: none
  /// @param tokens   a file of what lets this side in at others' pages; empty: none
  explicit NetworkOnDemand(const Console& console, std::string policy = {}, std::string tokens = {})
      : console_(console), policy_(std::move(policy)), tokens_(std::move(tokens)) {}

  /// For `load`: placeholders of components in other processes.
  deploy::MakePlaceholder placeholders();
  /// For `load`: what writes the inputs that are open to others.
  deploy::MakeInlets inlets();

  /// Looks at what the deployment says of the network, without listening.
  void check(const document::Document& document, base::Diagnostics& diagnostics);

  /// Makes the node and listens for `application`, which has not started, if the deployment or the
  /// command line asks for it.
  /// @return false after an error, which was told
  bool open(const document::Document& document, const RunArguments& arguments,
            exec::Application& application);
  /// It has a part in a network, or will have.
  bool wanted(const document::Document& document, const RunArguments& arguments) const;
  void serve();
  void leave();

 private:
  remote::Network& network();
  std::shared_ptr<websocket::Messages> serve_foxglove();

  const Console& console_;
  const std::string policy_;
  const std::string tokens_;
  std::vector<std::shared_ptr<websocket::Transport>> web_;
  std::vector<std::shared_ptr<websocket::Messages>> messages_;
  /// They ask the node, and end once it has gone.
  std::vector<std::unique_ptr<foxglove::Server>> foxglove_;
  std::unique_ptr<remote::Network> network_;
};

}  // namespace armature::cli
