// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/own_priority.hpp"

#include <sched.h>

namespace armature::platform {

int own_priority() {
  sched_param parameters{};
  if (::sched_getscheduler(0) != SCHED_FIFO || ::sched_getparam(0, &parameters) != 0) return 0;
  return parameters.sched_priority;
}

bool set_own_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
}

}  // namespace armature::platform
