// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_report_book.hpp"

#include <algorithm>
#include <limits>

#include "robots/janus/aic/aic_protocol.hpp"

namespace armature::janus {

std::int32_t AicReportBook::counts() const {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t kMostCounts = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(unreported_, kLeast, kMostCounts));
}

void AicReportBook::skip(int count) {
  for (int i = 0; i < count; ++i) counter_ = next_counter(counter_);
}

void AicReportBook::hand_over(std::uint32_t id, std::int32_t counts) {
  waiting_[count_++] = {id, counts, counter_};
  unreported_ -= counts;
  counter_ = next_counter(counter_);
}

void AicReportBook::acknowledge(std::uint32_t id) {
  if (count_ == 0 || waiting_.front().id != id) return;
  std::copy(waiting_.begin() + 1, waiting_.end(), waiting_.begin());
  --count_;
}

void AicReportBook::take_back() {
  if (count_ == 0) return;
  counter_ = waiting_.front().counter;
  for (std::size_t i = 0; i < count_; ++i) unreported_ += waiting_[i].counts;
  count_ = 0;
}

}  // namespace armature::janus
