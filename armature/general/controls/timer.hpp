// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"

namespace armature::general {

/// Raises an event each time that a period has passed, in the first of its cycles after that. It
/// counts from its start, or from `restart`.
class Timer final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    restart();
    return component::accepted();
  }
  void restart() {
    begin_ = time();
    ticks_ = 0;
    rings_ = true;
  }
  void on_update() override {
    const double passed = base::to_seconds(time() - begin_);
    time_.write(passed);
    const bool due = passed + kAlmost >= static_cast<double>(ticks_ + 1) * period_;
    if (!due || !rings_) return;
    ++ticks_;
    rings_ = repeat_;
    tick_.raise();
  }

  /// [s] Sums of periods are exact to less than that.
  static constexpr double kAlmost = 1e-9;

  component::Property<double> period_{
      this, "Period", 1.0, "until the event", "s", component::range(1e-6, 1e9)};
  component::Property<bool> repeat_{this, "Repeat", true, "once only if false"};
  component::OutputPort<double> time_{this, "Time", "since the start", "s"};
  component::Event<> tick_{this, "Tick", "the period has passed"};
  component::Operation<void()> restart_{this, "restart", component::serve<&Timer::restart>,
                                        "counts from now"};
  base::Time begin_{};
  std::uint64_t ticks_ = 0;
  bool rings_ = true;
};

}  // namespace armature::general
