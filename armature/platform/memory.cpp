// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/memory.hpp"

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace armature::platform {
namespace {

/// A line of /proc/self/maps.
struct Mapping {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
  char access[5] = "";

  bool allows(char what, int place) const { return access[place] == what; }
  std::size_t size() const { return end - begin; }
  /// Of a stack; the unused part of a heap looks alike but for its size.
  bool is_guard() const {
    constexpr std::size_t kLargest = 64 * 1024;
    return !allows('r', 0) && !allows('w', 1) && !allows('x', 2) && size() <= kLargest;
  }
};

Mapping mapping_of(const std::string& line) {
  Mapping mapping;
  std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %4s", &mapping.begin, &mapping.end,
              mapping.access);
  return mapping;
}

void populate(const Mapping& mapping) {
  constexpr std::size_t kLargest = 256u << 20;
  const bool data = mapping.allows('w', 1) && mapping.allows('p', 3);
  const bool code = mapping.allows('x', 2);
  if ((!data && !code) || mapping.size() > kLargest) return;
  // Fails on kernels before 5.14; then pages come when they are first used, as without this.
  madvise(reinterpret_cast<void*>(mapping.begin), mapping.size(),  // NOLINT
          data ? MADV_POPULATE_WRITE : MADV_POPULATE_READ);
}

void release(std::uintptr_t begin, std::uintptr_t end) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  begin = begin / page * page;
  void* const pages = reinterpret_cast<void*>(begin);  // NOLINT
  munlock(pages, end - begin);
  madvise(pages, end - begin, MADV_DONTNEED);
}

/// Data may differ from the file, also where it is read-only by now: only code comes back as it
/// was.
bool is_code(const ElfW(Phdr) & segment) {
  return segment.p_type == PT_LOAD && (segment.p_flags & PF_X) != 0 &&
         (segment.p_flags & PF_W) == 0;
}

int release_code_of(dl_phdr_info* object, std::size_t, void* libraries) {
  const std::string_view path = object->dlpi_name;
  const std::string_view file = path.substr(path.rfind('/') + 1);
  const auto& names = *static_cast<std::span<const std::string_view>*>(libraries);
  const bool meant = std::any_of(names.begin(), names.end(),
                                 [&](std::string_view name) { return file.starts_with(name); });
  if (!meant) return 0;
  for (const ElfW(Phdr) & segment : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr;
    if (is_code(segment)) release(begin, begin + segment.p_memsz);
  }
  return 0;
}

}  // namespace

base::Result<void> lock_memory() {
  malloc_trim(0);  // what was needed for loading only
  // On fault: not the parts of stacks and libraries that nobody uses.
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) {
    return base::Error{"memory cannot be locked: " + std::generic_category().message(errno) +
                       "; run as root, or raise memlock in /etc/security/limits.conf, or give the "
                       "program CAP_IPC_LOCK"};
  }
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TOP_PAD, 0);  // no reserve of 128 KB, locked too, in the heap of each thread
  return {};
}

void unlock_memory() {
  constexpr int kTrimThreshold = 128 * 1024;  // glibc's defaults
  constexpr int kMmapMax = 65536;
  constexpr int kTopPad = 128 * 1024;
  mallopt(M_TRIM_THRESHOLD, kTrimThreshold);
  mallopt(M_MMAP_MAX, kMmapMax);
  mallopt(M_TOP_PAD, kTopPad);
  munlockall();
}

void populate_memory() {
  std::ifstream maps("/proc/self/maps");
  std::string line;
  bool above_guard = false;
  while (std::getline(maps, line)) {
    const Mapping mapping = mapping_of(line);
    const bool main_stack = line.find("[stack]") != std::string::npos;
    // Every stack but the first thread's lies directly above a guard page.
    if (!main_stack && !above_guard) populate(mapping);
    above_guard = mapping.is_guard();
  }
}

void release_code(std::span<const std::string_view> libraries) {
  dl_iterate_phdr(release_code_of, &libraries);
}

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace armature::platform
