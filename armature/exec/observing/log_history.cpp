// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/observing/log_history.hpp"

namespace armature::exec {

void LogHistory::add(const rt::LogRecord& record) {
  if (lines_.size() == kCapacity) lines_.pop_front();
  lines_.push_back(
      {++last_, record.time, record.level, std::string(record.component.view()), record.message()});
}

}  // namespace armature::exec
