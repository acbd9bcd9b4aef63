// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/key.hpp"

#include <cstdio>
#include <string>

#include "armature/base/seconds.hpp"

namespace armature::studio::internal {
namespace {

std::string seconds_text(base::Duration time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", base::to_seconds(time));
  return text;
}

}  // namespace

base::Duration Key::renew(base::Time now) {
  if (!is_down(now)) {
    pressed_at_ = now;
    used_ = false;
  }
  down_ = true;
  renewed_at_ = now;
  return renewed_at_ - pressed_at_;
}

base::Result<void> Key::use(base::Time now) {
  if (!is_down(now)) return base::Error{"the key is not held: hold it for 1 s"};
  const base::Duration held = renewed_at_ - pressed_at_;
  if (held < kHold) {
    return base::Error{"the key was held for " + seconds_text(held) + ": hold it for 1 s"};
  }
  if (used_) {
    return base::Error{"the key has let one act through: let go of it, then hold it again"};
  }
  used_ = true;
  return {};
}

}  // namespace armature::studio::internal
