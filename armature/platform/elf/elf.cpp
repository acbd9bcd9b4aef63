// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/internal/elf.hpp"

#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace armature::platform {

Elf::Elf(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  struct stat status {};
  if (::fstat(fd, &status) == 0 && status.st_size > static_cast<off_t>(sizeof(ElfW(Ehdr)))) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (mapped != MAP_FAILED) {
      bytes_ = static_cast<const char*>(mapped);
      size_ = size;
    }
  }
  ::close(fd);
}

Elf::~Elf() {
  if (size_ > 0) ::munmap(const_cast<char*>(bytes_), size_);
}

template <typename Entry>
std::span<const Entry> Elf::table(std::size_t offset, std::size_t count) const {
  if (offset > size_ || count > (size_ - offset) / sizeof(Entry)) return {};
  return {reinterpret_cast<const Entry*>(bytes_ + offset), count};
}

std::span<const ElfW(Phdr)> Elf::segments() const {
  if (size_ == 0 || std::memcmp(bytes_, ELFMAG, SELFMAG) != 0) return {};
  return table<ElfW(Phdr)>(header().e_phoff, header().e_phnum);
}

std::span<const ElfW(Shdr)> Elf::sections() const {
  if (size_ == 0 || std::memcmp(bytes_, ELFMAG, SELFMAG) != 0) return {};
  return table<ElfW(Shdr)>(header().e_shoff, header().e_shnum);
}

std::span<const ElfW(Sym)> Elf::symbols(const ElfW(Shdr) & section) const {
  return table<ElfW(Sym)>(section.sh_offset, section.sh_size / sizeof(ElfW(Sym)));
}

const char* Elf::text(std::size_t offset) const {
  if (offset >= size_) return "";
  const bool ends = std::memchr(bytes_ + offset, '\0', size_ - offset) != nullptr;
  return ends ? bytes_ + offset : "";
}

}  // namespace armature::platform
