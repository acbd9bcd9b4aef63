// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "armature/exec/application.hpp"
#include "armature/inspect/application_view.hpp"
#include "armature/remote/control_queue.hpp"
#include "armature/ride/service.hpp"

namespace armature::remote {

/// An application's view (inspect::ApplicationView) for tools of other processes: the interface
/// `Inspector` of inspection.idl, hosted under the name `armature`. It decides who may ask, and
/// ends what goes on for a peer with the peer's connection.
///
/// Requests are understood by the node's I/O thread, which also asks the node's policy, and done by
/// the thread that controls the application. So what others ask for costs the application's threads
/// no more than a message between two cycles, and there is at most one at a time.
class Inspector {
 public:
  /// The name under which a node hosts it.
  static constexpr const char* kName = "armature";
  /// Requests of all peers together that wait for the controlling thread; more are refused.
  static constexpr std::size_t kMostWaiting = 64;
  /// Values in one request.
  static constexpr std::size_t kMostItems = 256;
  /// Commands that it remembers; of those that have ended the oldest is forgotten.
  static constexpr std::size_t kMostCommands = inspect::ApplicationView::kMostCommands;

  /// Is told what the operator should know.
  using Tell = std::function<void(const std::string&)>;

  /// @param queue  run by the controlling thread; to be closed before the inspector goes
  /// @param application  outlives the inspector
  Inspector(exec::Application& application, ControlQueue& queue, Tell tell = {});
  Inspector(const Inspector&) = delete;
  Inspector& operator=(const Inspector&) = delete;
  ~Inspector();

  /// For ride::Node::add; to be removed before the inspector goes.
  ride::Service& service();

  /// Cancels commands whose peers are gone: to be called often.
  /// @thread the controlling one
  void serve();

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace armature::remote
