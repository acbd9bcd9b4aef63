// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "armature/general/controls/named_call.hpp"

namespace armature::general {

/// Does the calls that its deployment names one after the other: each begins when the one before is
/// done. A command that is refused, fails or is cancelled, an operation that fails or returns
/// `false`, and a parameter that is not there fail the sequence. Cancelled, or stopped, it cancels
/// the call that is under way and begins no other.
class Sequence final : public component::Component,
                       public component::CallsByName,
                       private NamedCall::Listener {
 public:
  using Component::Component;

  std::size_t most_calls() const override { return 100; }
  component::Outcome declare_calls(std::vector<component::NamedCall> calls) override;

 private:
  component::Outcome on_activate() override;
  component::Outcome begin();
  void cancel_call() { steps_[step_]->call_off(); }
  void call_done(const void* result) override;
  void call_failed(std::string_view why) override;

  component::Command<> run_{this, "run", component::serve<&Sequence::begin>,
                            "does all calls, one after the other",
                            component::cancelled_by<&Sequence::cancel_call>};
  component::Event<> done_{this, "Done", "all calls were done", component::occasional};
  component::Event<std::int32_t, NamedCall::Why> failed_{
      this, "Failed", "a call was not done", component::occasional, {"call", "why"}};
  component::Attribute<std::int32_t> call_{this, "Call", 0,
                                           "the number of the one that began last, from 1"};
  component::Attribute<NamedCall::Why> why_{this, "Why", {}, "why it failed last"};
  std::vector<std::unique_ptr<NamedCall>> steps_;
  std::size_t step_ = 0;
};

}  // namespace armature::general
