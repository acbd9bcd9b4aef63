// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/observing/log_history.hpp"

#include <algorithm>

namespace armature::exec {
namespace {

/// Where the record of this number is in a full ring, also once there are more numbers than memory.
std::size_t ring_slot(std::uint64_t number) {
  return static_cast<std::size_t>((number - 1) % LogHistory::kCapacity);
}

}  // namespace

void LogHistory::add(const rt::LogRecord& record) {
  ++last_;
  if (records_.size() < kCapacity) {
    records_.push_back(record);
  } else {
    records_[ring_slot(last_)] = record;
  }
}

std::vector<LogLine> LogHistory::lines_after(std::uint64_t number, std::size_t most) const {
  std::vector<LogLine> lines;
  const std::uint64_t before_kept = last_ - records_.size();
  for (std::uint64_t n = std::max(number, before_kept) + 1; n <= last_ && lines.size() < most;
       ++n) {
    const rt::LogRecord& record = records_[ring_slot(n)];
    lines.push_back(
        {n, record.time, record.level, std::string(record.component.view()), record.message()});
  }
  return lines;
}

}  // namespace armature::exec
