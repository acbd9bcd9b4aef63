// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/dds_log.hpp"

#include <algorithm>
#include <mutex>
#include <string_view>
#include <utility>

#include <dds/dds.h>

namespace armature::ros2::internal {
namespace {

/// Of the process, as the log of Cyclone DDS is.
struct Counted {
  std::mutex mutex;
  DdsLog log;
};

Counted& counted() {
  static Counted instance;
  return instance;
}

/// Of what anybody may have sent: one line that a log can show.
std::string shown(std::string_view text) {
  constexpr std::size_t kMost = 90;
  while (text.ends_with('\n')) text.remove_suffix(1);
  std::string line(text.substr(0, kMost));
  std::ranges::replace_if(
      line, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return line;
}

void count(void* /*userdata*/, const dds_log_data_t* data) {
  std::string line = shown({data->message, data->size});
  const std::lock_guard lock(counted().mutex);
  ++counted().log.lines;
  counted().log.last = std::move(line);
}

}  // namespace

void count_dds_log() { dds_set_log_sink(&count, nullptr); }

DdsLog take_dds_log() {
  const std::lock_guard lock(counted().mutex);
  return std::exchange(counted().log, {});
}

}  // namespace armature::ros2::internal
