// SPDX-License-Identifier: Apache-2.0
#include "armature/record/console_writer.hpp"

#include <ostream>
#include <utility>

#include "armature/record/internal/seconds_text.hpp"

namespace armature::record {

ConsoleWriter::ConsoleWriter(std::ostream& to) : to_(to), channels_("console") {}

base::Result<ChannelId> ConsoleWriter::add_channel(Channel channel) {
  return channels_.add(std::move(channel));
}

base::Result<void> ConsoleWriter::write(const Sample& sample) {
  const auto value = channels_.decode(sample);
  if (!value) return base::Error{value.error()};
  const Channel& channel = channels_[sample.channel];
  to_ << internal::seconds_text(sample.time) << ' ' << channel.name << ' ' << value.value()->text();
  if (!channel.unit.empty()) to_ << ' ' << channel.unit;
  to_ << '\n';
  if (given_up()) return base::Error{"cannot write to the console"};
  ++unsaved_;
  return {};
}

base::Result<void> ConsoleWriter::flush() {
  to_.flush();
  if (given_up()) return base::Error{"cannot write to the console"};
  unsaved_ = 0;
  return {};
}

bool ConsoleWriter::given_up() const { return !to_.good(); }

}  // namespace armature::record
