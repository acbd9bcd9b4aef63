// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/context.hpp"
#include "armature/exec/blueprint.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/plan.hpp"

namespace armature::exec::internal {

/// One for each thread of the plan, in its order.
using Engines = std::vector<std::unique_ptr<Engine>>;

/// What all engines of an application have in common.
struct EngineSettings {
  component::Supervisor* supervisor;
  bool simulated;
  std::uint64_t measure_every;  ///< cycles; 0: about four times a second
  base::Time now;
};

Engines make_engines(const Blueprint& blueprint, const Plan& plan, const EngineSettings& settings);

std::vector<Engine*> pointers_to(const Engines& engines);

}  // namespace armature::exec::internal
