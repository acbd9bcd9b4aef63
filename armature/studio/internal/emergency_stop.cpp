// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/emergency_stop.hpp"

#include <optional>
#include <utility>

#include "armature/studio/internal/relay.hpp"

namespace armature::studio::internal {

/// One that was pressed.
struct EmergencyStops::Pressed {
  base::Time at;
  Told told;
  std::size_t asked = 0;  ///< components that have not answered
  std::string refused{};  ///< why one of them is not disarmed
  Outcome outcome{};
  bool over = false;
};

void EmergencyStops::press(base::Time now, Told told) {
  const auto pressed = std::make_shared<Pressed>(Pressed{now, std::move(told)});
  const auto components = relay_.to_disarm();
  if (!components) return end(*pressed, "what runs has not described itself");
  if (components->empty()) return end(*pressed, "nothing that runs is armed by an operator");
  pressed->asked = components->size();
  {
    const std::scoped_lock lock(mutex_);
    pressed_.push_back(pressed);
  }
  for (const std::string& component : *components) {
    relay_.disarm(component, [this, pressed, component](const base::Result<void>& done) {
      confirm(*pressed, component, done);
    });
  }
}

void EmergencyStops::confirm(Pressed& pressed, const std::string& component,
                             const base::Result<void>& done) {
  {
    const std::scoped_lock lock(mutex_);
    if (done) {
      pressed.outcome.disarmed.push_back(component);
    } else {
      pressed.refused = "'" + component + "' is not disarmed: " + done.error();
    }
    if (--pressed.asked > 0 || pressed.over) return;
    pressed.over = true;
  }
  end(pressed, pressed.refused);
}

void EmergencyStops::look(base::Time now) {
  std::vector<std::shared_ptr<Pressed>> late;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& one : pressed_) {
      if (one->over || now - one->at < kPatience) continue;
      one->over = true;
      late.push_back(one);
    }
    std::erase_if(pressed_, [](const auto& one) { return one->over; });
  }
  for (const auto& one : late) end(*one, "the run does not confirm that it is disarmed");
}

/// Of one that nobody else ends any more.
void EmergencyStops::end(Pressed& pressed, const std::string& why_stop) {
  if (why_stop.empty()) return pressed.told(pressed.outcome);
  if (const auto stopped = stop_run_(why_stop); !stopped) {
    return pressed.told(base::Error{stopped.error()});
  }
  Outcome outcome;
  {
    const std::scoped_lock lock(mutex_);
    outcome = pressed.outcome;
  }
  outcome.stopped = why_stop;
  pressed.told(outcome);
}

}  // namespace armature::studio::internal
