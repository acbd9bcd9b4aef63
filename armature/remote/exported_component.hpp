// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "armature/exec/application.hpp"
#include "armature/remote/control_queue.hpp"
#include "armature/remote/feed.hpp"
#include "armature/remote/interface_numbers.hpp"
#include "armature/remote/internal/peer_command.hpp"
#include "armature/ride/service.hpp"
#include "armature/types/type.hpp"

namespace armature::remote {

/// Writes a value to an input of the application; the error says why it is not open to others.
using WriteInput =
    std::function<base::Result<void>(component::InputPortBase&, const types::Value&)>;

/// A component of a running application as a service of a node. What peers ask for is done by the
/// controlling thread in their order; real-time threads are asked as every tool asks them.
class ExportedComponent final : public ride::Service {
 public:
  using Tell = internal::PeerCommand::Tell;

  /// @param numbers  of the component's model; all outlive this
  ExportedComponent(const InterfaceNumbers& numbers, component::Component& component,
                    exec::Application& application, ControlQueue& queue, WriteInput write,
                    Tell tell = {});
  ~ExportedComponent() override;

  component::Component& component() const { return component_; }

  /// Sends what came since: events, samples, how commands fare; cancels those whose peers are gone.
  /// @return what was dropped on the way, since the last call
  /// @thread the controlling one, while the application runs
  std::uint64_t serve();

 private:
  /// What a peer asked for.
  struct Request {
    NumberedMember member;
    std::vector<types::Value> arguments;
    ride::PendingReply reply;
    ride::Origin origin;
  };
  struct UnderWay {
    std::size_t index;
    internal::PeerCommand command;
    ride::PendingReply reply;
    double told = -1.0;  ///< progress
  };

  ride::Executed execute(ride::Number number, ride::Decoder& parameters,
                         ride::Reply& reply) override;
  std::vector<const types::Type*> parameters_of(const NumberedMember& member) const;
  void perform(Request& request);
  void call(Request& request);
  void begin(Request& request);
  void write(Request& request);
  void fail(ride::PendingReply& reply, std::string_view member, std::string_view problem);
  void follow_commands();
  bool follow(UnderWay& command);
  void open_and_close_feeds();
  void publish_sample(ride::Number number, std::uint64_t sequence, base::Time time,
                      const types::Type& type, const void* value);

  const InterfaceNumbers& numbers_;
  component::Component& component_;
  exec::Application& application_;
  ControlQueue& queue_;
  WriteInput write_;
  const Tell tell_;
  std::vector<UnderWay> under_way_;
  std::uint64_t changes_seen_ = 0;
  bool any_open_ = false;  ///< of the feeds

  struct Event {
    ride::Number number;
    std::size_t index;
    EventFeed feed;
  };
  struct Output {
    ride::Number number;
    std::size_t index;
    PortFeed feed;
  };
  std::vector<std::unique_ptr<Event>> events_;
  std::vector<std::unique_ptr<Output>> outputs_;
};

}  // namespace armature::remote
