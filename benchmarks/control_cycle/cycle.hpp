// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>

#include "armature/exec/application.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::benchmarks {

class Pacer;

/// How the cycle is spread over threads.
struct CycleThreads {
  exec::Activity sampler;
  exec::Activity sensor;
  exec::Activity controller;
  exec::Activity actuator;
  base::Duration period =
      std::chrono::milliseconds(1);  ///< for which the joints' limiters are made
};

/// The whole cycle in the sampler's thread.
CycleThreads one_thread();

/// The sampled-control cycle of `joints` joints, of the library's components; the cards and what
/// says where to go are stand-ins.
exec::Blueprint make_cycle(int joints, const CycleThreads& threads);

/// Adds what runs the cycle again and again.
Pacer& add_pacer(exec::Blueprint& blueprint, int joints);

/// Arms the joints, and waits until they stand and are driven to their place. Throws if that does
/// not succeed.
/// @param cycle  runs a cycle, where the sampler has no period
void arm(exec::Application& application, const std::function<void()>& cycle = {});

}  // namespace armature::benchmarks
