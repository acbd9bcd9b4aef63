// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/transport.hpp"
#include "armature/rt/log.hpp"

namespace armature::studio {

/// What a studio works on, and where it listens.
struct ServerOptions {
  std::string file;        ///< the deployment, which need not be there yet; or an address
  bool elsewhere = false;  ///< it is the address of an application that runs
  /// To reach it by, beside TCP and Unix-domain sockets.
  std::vector<std::shared_ptr<ride::Transport>> transports;
  std::string listen;       ///< `ws://127.0.0.1:8080`, or with a certificate `wss://0.0.0.0:8443`
  std::string certificate;  ///< file in PEM form; empty: nothing is encrypted
  std::string key;          ///< its private key
  std::string pages;        ///< the folder with the studio's page
  std::string policy;       ///< of who may do what; empty: whoever opens the page may do all
  std::string folder;       ///< for what a studio leaves, of all deployments
  std::string program;      ///< `armature`, for checks and runs
  std::vector<std::string> arguments;             ///< of both, behind the file's name
  std::function<void(const rt::LogRecord&)> log;  ///< called by any thread
};

/// `armature studio`: a deployment's texts, checks and runs for pages in browsers, which are peers
/// of RIDE (workbench.idl), or an application that runs elsewhere. Checks and runs are processes of
/// their own.
class Server {
 public:
  /// Listens; nothing after an error.
  static std::unique_ptr<Server> make(const ServerOptions& options, base::Diagnostics& diagnostics);
  Server() = default;
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  virtual ~Server() = default;

  /// Addresses to open in a browser of this machine.
  virtual std::vector<std::string> pages() const = 0;
  /// Addresses for Foxglove, with the secret that lets it in.
  virtual std::vector<std::string> foxglove() const = 0;
  /// Does what is to be done, and waits for more, at most so long.
  /// @thread one
  virtual void serve(base::Duration limit) = 0;
  /// The process of the run that goes on when this ends; 0: nothing runs.
  virtual int running() const = 0;
};

/// `Server::make` as who loads this library when it is asked for has it: most runs of the program
/// are no studio.
using MakeServer = std::unique_ptr<Server>(const ServerOptions&, base::Diagnostics&);
inline constexpr const char* kMakeServerSymbol = "armature_studio_make_server";

}  // namespace armature::studio
