// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "armature/component/author.hpp"

namespace armature::controllers {

/// Begins a sampling period in each of its cycles, or when `trigger` is called (paper 1, section
/// 3): writes SamplePort, then raises Sample. A Sample that a handler in another thread could not
/// take is counted.
/// @rt nonblocking, no allocation
class Sampler final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override;
  void on_update() override { begin_sample(); }
  void trigger();
  void begin_sample();

  component::OutputPort<std::uint64_t> sample_port_{
      this, "SamplePort",
      "number of the sample, from 1; to the SamplePort of others, "
      "or for the record"};
  component::Event<> sample_{this, "Sample", "a sampling period begins"};
  component::Operation<void()> trigger_{this, "trigger", component::serve<&Sampler::trigger>,
                                        "begins a sampling period now, while it runs",
                                        component::in_own_thread};
  component::Attribute<int> undelivered_{this, "undelivered", 0,
                                         "samples since the start that a handler had no room for"};

  std::uint64_t samples_ = 0;
};

}  // namespace armature::controllers
