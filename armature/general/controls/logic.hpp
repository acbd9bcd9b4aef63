// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"

namespace armature::general {

/// What a Logic makes of its inputs.
enum class Gate : std::uint8_t {
  kAnd,  ///< all are true
  kOr,   ///< one is true
  kXor,  ///< an odd number is true
  kNor,  ///< none is true; of a single input: the opposite
};
ARMATURE_ENUM(Gate, kAnd, kOr, kXor, kNor);

/// Combines truth values whenever one arrives and all were written; tells when the result changes.
class Logic final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    known_ = false;
    return component::accepted();
  }
  void combine(std::size_t, bool) {
    std::size_t holding = 0;
    for (std::size_t i = 0; i < in_.size(); ++i) {
      const auto reading = in_[i].read();
      if (!reading) return;
      if (reading.value) ++holding;
    }
    say(result_of(holding));
  }
  bool result_of(std::size_t holding) const {
    switch (gate_.get()) {
      case Gate::kAnd:
        return holding == in_.size();
      case Gate::kOr:
        return holding > 0;
      case Gate::kXor:
        return holding % 2 == 1;
      case Gate::kNor:
        return holding == 0;
    }
    return false;
  }
  void say(bool result) {
    const bool changed = known_ && result != result_;
    result_ = result;
    known_ = true;
    out_.write(result);
    if (!changed) return;
    if (result) became_true_.raise();
    if (!result) became_false_.raise();
  }

  component::Property<Gate> gate_{this, "Gate", Gate::kAnd, "how the inputs are combined"};
  component::Property<int> inputs_{this, "Inputs", 2, "how many", "", component::range(1, 1000)};
  component::InputPorts<bool> in_{
      this, "In", inputs_, "what is combined", "", component::on_data<&Logic::combine>};
  component::OutputPort<bool> out_{this, "Out", "the result"};
  component::Event<> became_true_{this, "BecameTrue", "the result is true now"};
  component::Event<> became_false_{this, "BecameFalse", "the result is false now"};
  bool result_ = false;
  bool known_ = false;
};

}  // namespace armature::general
