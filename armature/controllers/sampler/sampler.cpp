// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/sampler/sampler.hpp"

namespace armature::controllers {

component::Outcome Sampler::on_start() {
  samples_ = 0;
  undelivered_.assign(0);
  return component::accepted();
}

void Sampler::trigger() {
  if (state() == component::State::kRunning) {
    begin_sample();
  } else {
    log_warning("trigger: no sample while the sampler is {}", name_of(state()));
  }
}

void Sampler::begin_sample() {
  sample_port_.write(++samples_);
  if (sample_.raise() == component::RaiseStatus::kQueueFull) undelivered_.assign(undelivered_ + 1);
}

}  // namespace armature::controllers
