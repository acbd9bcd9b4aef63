// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/base/seconds.hpp"
#include "armature/component/author.hpp"

namespace armature::general {

/// Raises an event each time that a period has passed, in the first of its cycles after that. It
/// counts from its start, or from `restart`, until `stop`; one that waits only from `restart` on.
class Timer final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    begin();
    counts_ = !waits_;
    return component::accepted();
  }
  void begin() {
    begin_ = time();
    ticks_ = 0;
    rings_ = true;
    counts_ = true;
  }
  component::Outcome restart() {
    begin();
    restart_.complete();
    return component::accepted();
  }
  component::Outcome stop() {
    counts_ = false;
    stop_.complete();
    return component::accepted();
  }
  void on_update() override {
    if (!counts_) return;
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
  component::Property<bool> waits_{this, "Waits", false, "counts nothing before `restart`"};
  component::OutputPort<double> time_{this, "Time", "since it counts", "s"};
  component::Event<> tick_{this, "Tick", "the period has passed"};
  component::Command<> restart_{this, "restart", component::serve<&Timer::restart>,
                                "counts from now"};
  component::Command<> stop_{this, "stop", component::serve<&Timer::stop>,
                             "counts no more until `restart`"};
  base::Time begin_{};
  std::uint64_t ticks_ = 0;
  bool rings_ = true;
  bool counts_ = true;
};

}  // namespace armature::general
