// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/process.hpp"

#include <sys/utsname.h>
#include <unistd.h>

namespace armature::platform {

std::string kernel_version() {
  utsname names{};
  if (::uname(&names) != 0) return {};
  return std::string(names.release) + " " + names.version;
}

void exit_now(int status) { ::_exit(status); }

}  // namespace armature::platform
