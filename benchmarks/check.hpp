// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <system_error>

namespace armature::benchmarks {

/// Throws with what `errno` says about `what`, a system call, if it was not done.
inline void check(bool done, const char* what) {
  if (!done) throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace armature::benchmarks
