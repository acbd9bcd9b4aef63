// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "armature/component/operations/call_parameters.hpp"
#include "armature/component/untyped.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::exec {

/// An event that commands: each time that `On` is raised, `Do` is given, with parameters from the
/// event, from ports and from the deployment (paper 4, section II.B: signals and slots). It runs in
/// the raiser's thread, the command in its own component's.
///
/// A port that was never written, or whose value is older than `max_age`, is a refusal, and so is
/// more than kMost commands under way. Each refusal and failure is counted; it raises Failed, of
/// refusals on the spot once for all that come before it is raised; it is logged when its reason is
/// another one than before. Done and Failed are raised by a message, never while On is handled, so
/// that what follows may begin it again. Events and commands that set each other off without any
/// time passing are a fault.
///
/// While it is stopped, events command nothing; a command that is under way goes on, and its end is
/// told nobody. Before the application stops it rests: what it gave is cancelled.
/// @rt nonblocking, no allocation, O(parameters)
class EventCommand final : public component::Component {
 public:
  using Why = base::FixedText<127>;
  static constexpr std::size_t kMost = 16;
  /// How it calls what it uses; a deployment binds them.
  static constexpr std::string_view kOn = "On";
  static constexpr std::string_view kDo = "Do";

  /// @param max_age  of the values of ports; 0: any
  EventCommand(std::string name, const component::EventBase& event,
               const component::CommandBase& command,
               std::vector<component::CallParameter> parameters, base::Duration max_age);

  const std::vector<component::CallParameter>& parameters() const { return parameters_.all(); }
  base::Duration max_age() const { return max_age_; }

  /// What it gave is cancelled, and it gives nothing until it is started again.
  /// @thread any
  void rest() { do_.rest(); }

 private:
  component::Outcome on_activate() override;
  component::Outcome on_start() override;
  void on_stop() override { do_.forget(); }
  void on_cleanup() override { do_.forget(); }
  bool runs_in_circles();
  void give(const void* const* members);
  void refuse(std::string_view reason);
  void ended(component::CommandStage stage, std::string_view reason);
  void fail(std::string_view reason);

  /// Of what was refused here; one on its way tells of those that come meanwhile, too.
  struct Refusal final : rt::Message {
    explicit Refusal(EventCommand& its_owner) : rt::Message(&deliver), owner(its_owner) {}
    static void deliver(rt::Message& message);
    EventCommand& owner;
    bool on_its_way = false;
    Why why;
  };

  component::UntypedEventHandler on_;
  component::UntypedCommandCaller do_;
  component::Event<> done_{this, "Done", "the command was done", component::occasional};
  component::Event<Why> failed_{this,
                                "Failed",
                                "the command was refused, failed or was cancelled",
                                component::occasional,
                                {"why"}};
  component::Attribute<std::int64_t> given_{this, "Given", 0, "commands that were sent"};
  component::Attribute<std::int64_t> refused_{
      this, "Refused", 0, "commands that were refused, or not sent for want of a value"};
  component::Attribute<std::int64_t> failures_{this, "Failures", 0,
                                               "commands that failed or were cancelled"};

  component::CallParameters parameters_;
  base::Duration max_age_;
  base::Time given_at_{};
  std::size_t given_then_ = 0;  ///< so many at that time
  Refusal refusal_{*this};
  Why last_why_;
};

/// Of a blueprint: what gives `command` whenever `event` is raised, with its peers and bindings.
/// @param name, parameters, max_age  as the constructor of EventCommand takes them
/// @param event_where, command_where  where the user named them
ComponentEntry event_command_entry(std::string name, const component::EventBase& event,
                                   const component::CommandBase& command,
                                   std::vector<component::CallParameter> parameters,
                                   base::Duration max_age, const base::Location& event_where = {},
                                   const base::Location& command_where = {});

}  // namespace armature::exec
