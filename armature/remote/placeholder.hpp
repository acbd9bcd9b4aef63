// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/operations/commands_under_way.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/remote/interface_numbers.hpp"
#include "armature/remote/link_to.hpp"
#include "armature/ride/peer.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::remote {

/// A component of another process, in this application: what it raises and writes is raised and
/// written here, calls and commands and what is written to its inputs go there. Its thread, which
/// is not real-time, waits for the other process; nobody else does.
///
/// While the other process cannot be reached it is in a run-time error, calls are kUnreachable, and
/// the readers of its outputs are told that their writer is lost. It recovers by itself.
class Placeholder final : public component::StandIn {
 public:
  /// What it stands for.
  struct Original {
    /// Has the members, and never runs: of a model, with the properties that shape its ports, or
    /// described by a file.
    std::unique_ptr<component::Component> prototype;
    std::unique_ptr<const InterfaceNumbers> numbers;  ///< how the members are called
    std::string name;                                 ///< in its process
  };

  /// @param name   in this application
  /// @param where  makes the peer when it is needed, so that a check needs no network
  Placeholder(std::string name, Original original, const std::string& peer_address,
              std::function<ride::Peer&()> where);
  ~Placeholder() override;

  component::Attribute<std::string> address{this, "PeerAddress", "", "where the component lives"};
  component::Attribute<bool> connected{this, "PeerConnected", false,
                                       "the process where it lives can be reached"};
  component::Attribute<int> losses{this, "PeerLosses", 0, "how often the connection was lost"};
  component::Attribute<double> answer_limit{this, "PeerAnswerLimit",
                                            1.0,  "how long the answer to a call is waited for",
                                            "s",  component::changeable_while_running};
  component::Attribute<int> missed{this, "PeerMissed", 0,
                                   "events and samples that were lost on the way here"};
  component::Attribute<int> unsent{this, "PeerUnsent", 0,
                                   "values and commands that could not be sent"};
  component::Event<> found{this, "PeerFound", "the process where it lives was reached"};
  component::Event<> lost{this, "PeerLost", "the process where it lives can no longer be reached"};

  void pass_on(component::InputPortBase& input, const void* value) override;
  component::CallStatus call(component::OperationBase& operation, const void* const* arguments,
                             void* result) override;
  /// Of commands without cancellation and progress, which are done there at once.
  component::CommandsUnderWay* several(const component::CommandBase& command) override;
  component::Outcome begin(component::CommandBase& command, const void* const* arguments) override;
  void cancel(component::CommandBase& command) override;

 private:
  /// Something that came from the other process, on its way to this component's thread.
  struct Arrival {
    enum class Kind : std::uint8_t { kEvent, kSample, kProgress, kEnded, kConnection };
    Kind kind;
    std::size_t index = 0;
    std::vector<types::Value> values{};
    bool misfit = false;  ///< what came has no place here: there are no values
    std::uint64_t sequence = 0;
    double progress = 0.0;
    std::uint64_t run = 0;  ///< of a command: which
    bool good = false;      ///< it was done
    std::string text{};
  };
  /// Has the component's thread look at what arrived.
  struct Bell final : rt::Signal {
    explicit Bell(Placeholder& placeholder) : rt::Signal(&Bell::deliver), self(placeholder) {}
    static void deliver(rt::Message& message);
    Placeholder& self;
  };
  /// Outlives the component: an answer may come when nobody waits for it any more.
  struct Mailbox {
    /// @thread any
    void put(Arrival arrival);

    std::mutex mutex;
    Placeholder* owner = nullptr;  ///< nullptr: nothing is taken
    std::vector<Arrival> arrivals;
    std::uint64_t overflowed = 0;
  };
  struct Output {
    std::unique_ptr<component::OutputPortBase> port;
    std::size_t index;
    std::uint64_t sequence = 0;  ///< of the last sample
    bool misfit = false;         ///< a sample had no place here
  };
  struct Input {
    std::unique_ptr<component::InputPortBase> port;
    std::size_t index;
  };
  struct Event {
    std::unique_ptr<component::EventBase> twin;
    std::size_t index;
    bool misfit = false;  ///< one had no place here
  };
  struct Operation {
    std::unique_ptr<component::OperationBase> twin{};
    std::size_t index = 0;
    std::uint64_t run = 0;  ///< of a command of which one is under way at a time: counts
    std::unique_ptr<component::CommandsUnderWay> several{};  ///< of one of which several may be
  };

  component::Outcome on_start() override;
  void on_stop() override;
  void on_cleanup() override;

  void make_twins();
  void add_operation(const component::OperationBase& original, const NumberedMember& member);
  void subscribe();
  void listen(NumberedMember::Kind kind, std::size_t index, Arrival::Kind arrival);
  bool take(NumberedMember::Kind kind, std::size_t index, ride::Decoder& members,
            Arrival& arrival) const;
  void let_go();
  void look_at_arrivals();
  void handle(Arrival& arrival);
  void handle_connection(const std::string& problem);
  void handle_sample(const Arrival& arrival);
  void note_misfit(bool& told, std::string_view member);
  Operation& operation_of(const component::OperationBase& twin);
  void handle_end(Operation& operation, const Arrival& arrival);
  void count(component::Attribute<int>& counter, std::uint64_t more = 1);

  const std::unique_ptr<component::Component> prototype_;
  const std::unique_ptr<const InterfaceNumbers> numbers_;
  const std::string remote_name_;
  std::function<ride::Peer&()> where_;
  std::vector<Output> outputs_;
  std::vector<Input> inputs_;
  std::vector<Operation> operations_;
  std::vector<Event> events_;
  std::unique_ptr<LinkTo> link_;
  std::vector<ride::Subscription> subscriptions_;
  Bell bell_{*this};
  const std::shared_ptr<Mailbox> mailbox_ = std::make_shared<Mailbox>();
};

}  // namespace armature::remote
