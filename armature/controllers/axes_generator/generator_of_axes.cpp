// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/axes_generator/generator_of_axes.hpp"

#include <algorithm>

#include "armature/component/face.hpp"
#include "armature/controllers/base/of_this_run.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

void GeneratorOfAxes::begin_run() {
  position_known_ = false;
  started_ = time();
  armed_ = false;
}

bool GeneratorOfAxes::knows_position() {
  if (position_known_) return true;
  const auto measured = measured_.read();
  if (!is_of_this_run(measured, started_)) return false;
  const std::optional<std::size_t> wrong = hold_at(measured.value);
  stepped_at_ = time();
  position_known_ = !wrong;
  if (wrong) refuse_measured(*wrong);
  return position_known_;
}

bool GeneratorOfAxes::may_move() {
  if (is_armed_.bound()) {
    const auto answer = is_armed_();
    if (answer.status != component::CallStatus::kWouldWait) return answer && answer.value;
  }
  if (!arm_.bound()) return true;
  return armed_ && face(arm_).source()->owner().state() == component::State::kRunning;
}

void GeneratorOfAxes::refuse_measured(std::size_t axis) {
  component::Reason why("nAxesSensorPosition of axis ");
  append_number(why, static_cast<double>(axis + 1)).append(" is ");
  append_number(why, measured_.read().value[axis]).append(", expected a finite number");
  fault(why);
}

void GeneratorOfAxes::write_desired(std::span<const double> positions,
                                    std::span<const double> velocities,
                                    std::span<const double> accelerations) {
  const auto write = [this](component::OutputPort<Vector>& port, std::span<const double> numbers) {
    std::copy(numbers.begin(), numbers.end(), numbers_.begin());
    port.write(numbers_);
  };
  write(position_, positions);
  write(velocity_, velocities);
  write(acceleration_, accelerations);
}

}  // namespace armature::controllers
