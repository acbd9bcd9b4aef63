// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/result.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/application.hpp"
#include "armature/ride/transport.hpp"
#include "armature/rt/log.hpp"

namespace armature::remote {

/// What a process's part in the network needs beside the deployment.
struct NetworkOptions {
  /// Makes a transport with the files that the network names; what is wrong is added to the
  /// diagnostics.
  using MakeTransport =
      std::function<std::shared_ptr<ride::Transport>(const document::Network&, base::Diagnostics&)>;
  MakeTransport tls;  ///< for `tls://`; without a certificate it only connects
  /// For `ws://`, which serves the folder of pages if there is one; with a certificate or an
  /// authority `wss://`.
  MakeTransport web;
  std::function<void(const rt::LogRecord&)> log;  ///< called by the controlling thread
  std::string policy{};  ///< a file with rules beside those of the deployment; empty: none
};

/// A process's part in the network: its node, the placeholders of an application, and its
/// components for others. It outlives the application. Functions are for the controlling thread.
class Network {
 public:
  Network() = default;
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;
  virtual ~Network() = default;

  /// What stands for a component that a deployment says is `remote`; nothing is connected yet.
  /// @param prototype  one of its model, with its properties
  virtual base::Result<std::unique_ptr<component::Component>> make_placeholder(
      const document::Component& written, std::unique_ptr<component::Component> prototype) = 0;

  /// What writes the inputs that a deployment opens for others.
  virtual std::unique_ptr<component::Component> make_inlets(
      const std::vector<component::InputPortBase*>& inputs) = 0;

  /// What is wrong with addresses, policy and certificates, as far as that is known without
  /// listening.
  virtual void check(const document::Document& document, base::Diagnostics& diagnostics) = 0;

  /// Makes the node, hosts the components of `application`, which has not started yet, and listens:
  /// so who connects finds all of them. After an error nothing listens.
  /// @param listen  addresses beside those of the document
  virtual void open(const document::Document& document, const std::vector<std::string>& listen,
                    exec::Application& application, base::Diagnostics& diagnostics) = 0;
  /// Where it listens, with the ports that it got.
  virtual std::vector<std::string> addresses() const = 0;

  /// Does what others asked for since, and sends what they subscribed to; while the application
  /// runs.
  virtual void serve() = 0;
  /// Before the application stops: nothing is done for others any more.
  virtual void leave() = 0;
};

std::unique_ptr<Network> make_network(const NetworkOptions& options);

}  // namespace armature::remote
