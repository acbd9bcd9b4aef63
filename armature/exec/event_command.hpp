// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "armature/component/untyped.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/types/type.hpp"

namespace armature::exec {

/// Where one parameter of a command comes from.
struct CommandParameter {
  /// Which of the members below counts.
  enum class From { kMember, kPort, kConstant };
  From from = From::kMember;
  std::size_t member = 0;                           ///< of the event
  std::string input;                                ///< its name, for a port
  const component::OutputPortBase* port = nullptr;  ///< whose latest value it is
  std::shared_ptr<const types::Value> constant;     ///< of the parameter's type
};

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
               const component::CommandBase& command, std::vector<CommandParameter> parameters,
               base::Duration max_age);

  /// True if a value of type `offered` can be a parameter: of the same type, or a number for a
  /// floating one.
  static bool takes(const types::Type& parameter, const types::Type& offered);

  const std::vector<CommandParameter>& parameters() const { return parameters_; }
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
  /// The value at `from` as the parameter takes it.
  const void* as_taken(std::size_t index, const void* from);
  /// Empty if all parameters are there.
  component::Reason collect(const void* const* members);
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

  std::vector<CommandParameter> parameters_;
  std::vector<std::unique_ptr<component::UntypedInputPort>> inputs_;  ///< of each; nullptr: no port
  base::Duration max_age_;
  std::vector<const void*> places_;
  /// A number of another type than the parameter's, which it becomes.
  struct Conversion {
    const types::Type* from = nullptr;  ///< nullptr: they are the same
    types::Value value;
  };
  std::vector<Conversion> conversions_;  ///< of each
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
                                   std::vector<CommandParameter> parameters, base::Duration max_age,
                                   const base::Location& event_where = {},
                                   const base::Location& command_where = {});

}  // namespace armature::exec
