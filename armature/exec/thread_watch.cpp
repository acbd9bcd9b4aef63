// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/thread_watch.hpp"

#include <limits>

namespace armature::exec {
namespace {

ThreadWatch::Picture empty_picture(std::size_t numbers) {
  return {std::vector<double>(numbers, std::numeric_limits<double>::quiet_NaN()),
          std::vector<base::Time>(numbers, base::Time::min()), 0};
}

bool are_of_one(const WatchedNumber& a, const WatchedNumber& b) {
  return a.port == b.port && a.property == b.property;
}

}  // namespace

ThreadWatch::ThreadWatch(std::vector<WatchedNumber> numbers, base::Duration interval)
    : numbers_(std::move(numbers)),
      interval_(interval),
      early_(interval / 4),
      picture_(empty_picture(numbers_.size())),
      latest_(picture_) {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (i == 0 || !are_of_one(numbers_[i - 1], numbers_[i])) runs_.push_back({i, i});
    runs_.back().end = i + 1;
  }
}

void ThreadWatch::copy(base::Time now) noexcept {
  due_ = now + interval_ - early_;
  ++picture_.number;
  for (const Run& run : runs_) {
    const WatchedNumber& first = numbers_[run.begin];
    if (first.port == nullptr) {
      copy_values(run, first.property->data(), now);
    } else if (first.port->current_sequence() > 0) {
      copy_values(run, first.port->current(), first.port->current_time());
    }
  }
  latest_.write(picture_);
}

void ThreadWatch::copy_values(const Run& run, const void* value, base::Time time) noexcept {
  for (std::size_t i = run.begin; i < run.end; ++i) {
    picture_.values[i] = numbers_[i].place.read(value);
    picture_.times[i] = time;
  }
}

}  // namespace armature::exec
