// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/component/author.hpp"
#include "benchmarks/errand.hpp"

namespace armature::benchmarks {

/// Runs cycles one after the other without a pause: the next begins when all joints have driven
/// their cards. Because it hears of `Sample` it lives in the joints' thread, and because it could
/// read their positions it is the last to hear of `Act`.
class Pacer final : public component::Component {
 public:
  using Component::Component;

  /// Runs `count` cycles; returns when the last one is over.
  /// @thread the one that measures
  void run_cycles(std::int64_t count) {
    left_ = count;
    begin_.send();
    finish_.wait();
  }

 private:
  void on_sample() {}
  void on_act() {
    if (--left_ > 0) {
      trigger_();
    } else {
      finish_.tell();
    }
  }

  component::Property<int> joints_{this, "joints", 2, "how many"};
  component::InputPorts<double> position_{this, "Position", joints_, "of each joint", "rad"};
  component::EventHandler<> sample_{this, "Sample", component::serve<&Pacer::on_sample>,
                                    "a cycle begins", component::leads_to_nothing()};
  component::EventHandler<> act_{this, "Act", component::serve<&Pacer::on_act>, "the cycle is over",
                                 component::leads_to_nothing()};
  component::OperationCaller<void()> trigger_{this, "trigger", "begins a cycle"};

  std::int64_t left_ = 0;
  Finish finish_;
  Errand begin_{*this, [this] { trigger_(); }};
};

}  // namespace armature::benchmarks
