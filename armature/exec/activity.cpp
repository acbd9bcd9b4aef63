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

std::string_view name_of(Activity::Kind kind) {
  switch (kind) {
    case Activity::Kind::kPeriodic:
      return "periodic";
    case Activity::Kind::kTriggered:
      return "triggered";
    case Activity::Kind::kSequential:
      return "sequential";
  }
  return "unknown";
}

std::string_view name_of(Activity::Scheduler scheduler) {
  switch (scheduler) {
    case Activity::Scheduler::kOther:
      return "other";
    case Activity::Scheduler::kRealtime:
      return "realtime";
    case Activity::Scheduler::kDeadline:
      return "deadline";
  }
  return "unknown";
}

}  // namespace armature::exec
