// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/sink.hpp"

#include <utility>

namespace armature::general {

base::Result<Sink> Sink::open(const std::string& path, const Open& open,
                              const std::vector<record::Channel>& channels) {
  auto writer = open(path);
  if (!writer) return base::Error{writer.error()};
  for (const record::Channel& channel : channels) {
    const auto added = writer.value()->add_channel(channel);
    if (!added) return base::Error{added.error()};
  }
  return Sink(path, std::move(writer).value());
}

void Sink::write(const record::Sample& sample) {
  if (given_up_) {
    ++not_written_;
  } else {
    note(writer_->write(sample), 1);
  }
}

void Sink::flush() {
  if (!given_up_) note(writer_->flush(), 0);
}

void Sink::close() {
  const bool gave_up_before = given_up_;
  const auto done = writer_->close();
  if (!gave_up_before) note(done, 0);
}

void Sink::note(const base::Result<void>& done, std::uint64_t lost) {
  if (done) return;
  not_written_ += lost;
  if (writer_->given_up()) {
    given_up_ = true;
    not_written_ += writer_->unsaved();
    complaint_ = done.error();
  } else if (!std::exchange(complained_of_sample_, true)) {
    complaint_ = done.error();
  }
}

std::string Sink::take_complaint() { return std::exchange(complaint_, {}); }

}  // namespace armature::general
