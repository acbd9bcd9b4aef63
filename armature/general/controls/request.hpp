// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "armature/component/described.hpp"
#include "armature/general/controls/named_call.hpp"
#include "armature/general/controls/unit_property.hpp"

namespace armature::general {

/// Asks the operation that its deployment names, each time that it is commanded to, and writes what
/// it returns. It waits for no answer: the command is done when the answer is there.
class Request final : public component::Component,
                      public component::CallsByName,
                      private NamedCall::Listener {
 public:
  using Component::Component;

  std::size_t most_calls() const override { return 1; }
  component::Outcome declare_calls(std::vector<component::NamedCall> calls) override;

 private:
  component::Outcome on_activate() override;
  component::Outcome begin();
  void forget() { question_->call_off(); }
  void call_done(const void* result) override;
  void call_failed(std::string_view why) override;

  UnitProperty unit_{this, "Unit", "of the result"};
  component::Command<> ask_{this, "ask", component::serve<&Request::begin>, "asks once",
                            component::cancelled_by<&Request::forget>};
  component::Event<NamedCall::Why> failed_{
      this, "Failed", "there is no answer", component::occasional, {"why"}};
  std::unique_ptr<NamedCall> question_;
  std::unique_ptr<component::DescribedOutput> result_;   ///< nullptr: nothing is returned
  std::unique_ptr<component::DescribedEvent> answered_;  ///< with the result, if there is one
};

}  // namespace armature::general
