// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/exec/blueprint.hpp"

namespace armature::benchmarks {

class Pacer;

/// How the cycle is spread over threads.
struct CycleThreads {
  exec::Activity sampler;
  exec::Activity sensor;
  exec::Activity controller;
  exec::Activity actuator;
};

/// The whole cycle in the sampler's thread.
CycleThreads one_thread();

/// The sampled-control cycle of `joints` joints.
exec::Blueprint make_cycle(int joints, const CycleThreads& threads);

/// Adds what runs the cycle again and again.
Pacer& add_pacer(exec::Blueprint& blueprint, int joints);

}  // namespace armature::benchmarks
