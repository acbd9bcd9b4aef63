// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/idle_states.hpp"

#include <cerrno>
#include <cstdint>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace armature::platform {

base::Result<IdleStateHold> IdleStateHold::take(const std::string& device) {
  const auto refused = [&device](int error) {
    return base::Error{"deep idle states cannot be held off: " + device + ": " +
                       std::generic_category().message(error) +
                       "; run as root, or let your group write the device by a udev rule"};
  };
  const int descriptor = ::open(device.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return refused(errno);
  IdleStateHold hold(descriptor);
  const std::int32_t longest_wakeup_us = 0;
  if (::write(descriptor, &longest_wakeup_us, sizeof longest_wakeup_us) < 0) return refused(errno);
  return hold;
}

IdleStateHold::~IdleStateHold() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace armature::platform
