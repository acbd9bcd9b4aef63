// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/activity.hpp"

namespace armature::exec {

Activity Activity::periodic(base::Duration period, int priority) {
  Activity activity;
  activity.kind = Kind::kPeriodic;
  activity.period = period;
  activity.priority = priority;
  activity.scheduler = priority > 0 ? Scheduler::kRealtime : Scheduler::kOther;
  return activity;
}

Activity Activity::triggered(int priority) {
  Activity activity;
  activity.kind = Kind::kTriggered;
  activity.priority = priority;
  activity.scheduler = priority > 0 ? Scheduler::kRealtime : Scheduler::kOther;
  return activity;
}

int urgency(const Activity& activity) {
  constexpr int kAboveAllPriorities = 100;
  switch (activity.scheduler) {
    case Activity::Scheduler::kDeadline:
      return kAboveAllPriorities;
    case Activity::Scheduler::kRealtime:
      return activity.priority;
    case Activity::Scheduler::kOther:
      return 0;
  }
  return 0;
}

}  // namespace armature::exec
