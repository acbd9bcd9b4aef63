// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/outlets.hpp"

#include <utility>
#include <vector>

#include "armature/base/quoted.hpp"

namespace armature::exec::internal {

Outlets::Outlets(const ApplicationOptions& options, const Clock& clock)
    : clock_(clock),
      simulated_(options.simulated),
      logs_(options.log),
      timeline_(options.timeline),
      black_boxes_(options.black_box) {}

void Outlets::set_engines(const Engines& engines, const Plan& plan) {
  const std::vector<Engine*> all = pointers_to(engines);
  logs_.set_engines(all);
  timeline_.set_engines(all, plan, simulated_);
}

void Outlets::set_black_boxes(const Engines& engines, const Blueprint& blueprint,
                              const Plan& plan) {
  black_boxes_.set_engines(engines, blueprint, plan, simulated_);
}

void Outlets::drain() {
  logs_.drain();
  timeline_.drain();
}

void Outlets::drain_after_turn(Engine& engine) {
  logs_.drain(engine);
  timeline_.drain_if_half_full();
}

void Outlets::say(const std::string& text) {
  if (!text.empty()) logs_.say(text, clock_.now());
}

void Outlets::write_black_boxes(Incidents& incidents) {
  say(black_boxes_.write_if_due(incidents, clock_.now()));
}

void Outlets::write_last_black_boxes(Incidents& incidents) {
  say(black_boxes_.write_last(incidents, clock_.now()));
}

void Outlets::end(base::Diagnostics& diagnostics) {
  drain();
  logs_.tell_losses(clock_.now());
  if (logs_.failure().empty()) return;
  diagnostics.warning(
      {}, "log lines are missing: their receiver threw " + base::quoted(logs_.failure()));
}

}  // namespace armature::exec::internal
