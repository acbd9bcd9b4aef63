// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "armature/component/author.hpp"
#include "armature/component/operations/calls_by_name.hpp"
#include "armature/component/untyped.hpp"

namespace armature::general {

/// A call that a deployment names, of an operation or a command, and how it ends; one at a time.
class NamedCall {
 public:
  using Why = base::FixedText<127>;

  /// Told once of each call that began, unless it was called off.
  class Listener {
   public:
    /// @param result  what was returned; nullptr: nothing
    /// @thread the component's own
    virtual void call_done(const void* result) = 0;
    /// @thread the component's own
    virtual void call_failed(std::string_view why) = 0;

   protected:
    ~Listener() = default;
  };

  NamedCall(component::Component& owner, Listener& listener, component::NamedCall call);

  /// `Component.operation`.
  std::string_view called() const { return called_; }
  /// nullptr: it returns nothing.
  const types::Type* result() const { return operation_.signature().result; }

  /// Makes room, once vectors have their sizes.
  /// @thread configuration only
  void prepare();
  /// Sends it; what keeps it from beginning is told the listener before this returns.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void begin();
  /// Cancels it, and nobody is told of its end.
  /// @rt nonblocking, no allocation
  /// @thread the component's own
  void call_off();

 private:
  static constexpr std::size_t kMost = 4;  ///< that are called off may still be under way

  component::CallStatus send();
  void answered(component::CallStatus status, const void* result);
  void ended(component::CommandStage stage, std::string_view reason);

  component::Component& owner_;
  Listener& listener_;
  std::string caller_name_;
  std::string called_;
  const component::OperationBase& operation_;
  component::CallParameters parameters_;
  std::unique_ptr<component::UntypedOperationCaller> operation_caller_;  ///< one of the two
  std::unique_ptr<component::UntypedCommandCaller> command_caller_;
};

}  // namespace armature::general
