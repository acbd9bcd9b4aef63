// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <iosfwd>

#include "armature/record/internal/channel_list.hpp"
#include "armature/record/recording.hpp"

namespace armature::record {

/// Writes a line for each sample, for people who watch:
///
///     0.010000000 PID1.Out 0.5 V
///     0.010000000 Head.pose {x: 1, y: 2}
class ConsoleWriter final : public Writer {
 public:
  /// @param to  lives as long as the writer
  explicit ConsoleWriter(std::ostream& to);

  base::Result<ChannelId> add_channel(Channel channel) override;
  base::Result<void> write(const Sample& sample) override;
  base::Result<void> flush() override;
  base::Result<void> close() override { return flush(); }
  bool given_up() const override;
  std::uint64_t unsaved() const override { return unsaved_; }

 private:
  std::ostream& to_;
  internal::ChannelList channels_;
  std::uint64_t unsaved_ = 0;
};

}  // namespace armature::record
