// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/thread_watch.hpp"

#include <limits>

namespace armature::exec {
namespace {

ThreadWatch::Picture empty_picture(std::size_t numbers) {
  return {std::vector<double>(numbers, std::numeric_limits<double>::quiet_NaN()),
          std::vector<base::Time>(numbers, base::Time::min()), 0};
}

}  // namespace

ThreadWatch::ThreadWatch(std::vector<WatchedNumber> numbers, base::Duration interval)
    : numbers_(std::move(numbers)),
      interval_(interval),
      early_(interval / 4),
      picture_(empty_picture(numbers_.size())),
      latest_(picture_) {}

void ThreadWatch::copy(base::Time now) noexcept {
  due_ = now + interval_ - early_;
  ++picture_.number;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const WatchedNumber& one = numbers_[i];
    if (one.port == nullptr) {
      picture_.values[i] = one.place.read(one.property->data());
      picture_.times[i] = now;
    } else if (one.port->current_sequence() > 0) {
      picture_.values[i] = one.place.read(one.port->current());
      picture_.times[i] = one.port->current_time();
    }
  }
  latest_.write(picture_);
}

}  // namespace armature::exec
