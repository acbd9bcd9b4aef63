// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <link.h>

namespace armature::platform {

/// An executable or shared library as it lies on the disk; everything is empty if it cannot be
/// read.
class Elf {
 public:
  explicit Elf(const std::string& path);
  Elf(const Elf&) = delete;
  Elf& operator=(const Elf&) = delete;
  ~Elf();

  std::span<const ElfW(Phdr)> segments() const;
  std::span<const ElfW(Shdr)> sections() const;
  std::span<const ElfW(Sym)> symbols(const ElfW(Shdr) & section) const;
  /// The text that begins at `offset`.
  const char* text(std::size_t offset) const;

 private:
  template <typename Entry>
  std::span<const Entry> table(std::size_t offset, std::size_t count) const;
  const ElfW(Ehdr) & header() const { return *reinterpret_cast<const ElfW(Ehdr)*>(bytes_); }

  const char* bytes_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace armature::platform
