// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/sync.hpp"

namespace armature::canopen {

can::Frame SyncProducer::step() noexcept {
  if (overflow_ == 0) return can::data_frame(cob_id_, {});
  counter_ = counter_ >= overflow_ ? std::uint8_t{1} : static_cast<std::uint8_t>(counter_ + 1);
  return can::data_frame(cob_id_, {counter_});
}

SyncConsumer::Heard SyncConsumer::take(const can::Frame& frame, base::Time time) noexcept {
  const bool mine = frame.kind == can::FrameKind::kData && !frame.extended && frame.id == cob_id_;
  if (!mine) return Heard::kOtherFrame;
  if (frame.size != (overflow_ == 0 ? 0 : 1)) return Heard::kWrongLength;
  if (overflow_ > 0) {
    const int expected = counter_ >= overflow_ ? 1 : counter_ + 1;
    if (heard_ && frame.data[0] != expected) ++skips_;
    counter_ = frame.data[0];
  }
  heard_ = time;
  return Heard::kSync;
}

bool SyncConsumer::missing(base::Time now) const noexcept {
  return heard_ && timeout_ > base::Duration{} && now > base::later(*heard_, timeout_);
}

}  // namespace armature::canopen
