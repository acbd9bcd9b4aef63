// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/memory.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include <sys/mman.h>
#include <unistd.h>

namespace armature::platform {

base::Result<void> lock_memory() {
#ifdef MCL_ONFAULT
  // Stacks and heaps are touched before start; locking on fault spares the pages nobody uses.
  const int flags = MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT;
#else
  const int flags = MCL_CURRENT | MCL_FUTURE;
#endif
  if (mlockall(flags) == 0) return {};
  return base::Error{"memory cannot be locked: " + std::generic_category().message(errno) +
                     "; run as root, or raise memlock in /etc/security/limits.conf, or give the "
                     "program CAP_IPC_LOCK"};
}

void unlock_memory() { munlockall(); }

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace armature::platform
