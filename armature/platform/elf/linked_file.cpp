// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/linked_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include <elf.h>

#include "armature/platform/file.hpp"

namespace armature::platform {
namespace {

/// More than any file has; a broken one would have the memory filled.
constexpr std::size_t kMostBytes = 16u << 20;

/// The structures of one width of addresses.
struct Wide {
  using Header = Elf64_Ehdr;
  using Section = Elf64_Shdr;
  using Dynamic = Elf64_Dyn;
};
struct Narrow {
  using Header = Elf32_Ehdr;
  using Section = Elf32_Shdr;
  using Dynamic = Elf32_Dyn;
};

/// Parts of a file, empty where it has none.
class Parts {
 public:
  explicit Parts(const std::string& path) : stream_(path, std::ios::binary) {}

  template <typename Entry>
  std::vector<Entry> read(std::uint64_t offset, std::uint64_t count) {
    if (count > kMostBytes / sizeof(Entry)) return {};
    std::vector<Entry> entries(static_cast<std::size_t>(count));
    const auto size = static_cast<std::streamsize>(count * sizeof(Entry));
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(reinterpret_cast<char*>(entries.data()), size);
    return stream_.gcount() == size ? entries : std::vector<Entry>{};
  }

 private:
  std::ifstream stream_;
};

/// The text that begins at `offset` of `texts`, up to its end.
std::string text_at(const std::vector<char>& texts, std::uint64_t offset) {
  if (offset >= texts.size()) return {};
  const auto at = static_cast<std::size_t>(offset);
  const char* const begin = texts.data() + at;
  return {begin, ::strnlen(begin, texts.size() - at)};
}

void add_folders(std::string_view list, std::vector<std::string>& folders) {
  while (!list.empty()) {
    const std::size_t colon = list.find(':');
    if (colon != 0) folders.emplace_back(list.substr(0, colon));
    list.remove_prefix(colon == std::string_view::npos ? list.size() : colon + 1);
  }
}

template <typename Width>
void read_dynamic(Parts& parts, LinkedFile& file) {
  const auto headers = parts.read<typename Width::Header>(0, 1);
  if (headers.empty()) return;
  const auto& header = headers.front();
  file.machine = header.e_machine;
  const auto sections = parts.read<typename Width::Section>(header.e_shoff, header.e_shnum);
  for (const auto& section : sections) {
    if (section.sh_type != SHT_DYNAMIC || section.sh_link >= sections.size()) continue;
    const auto& names = sections[section.sh_link];
    const auto texts = parts.read<char>(names.sh_offset, names.sh_size);
    using Dynamic = typename Width::Dynamic;
    for (const auto& entry :
         parts.read<Dynamic>(section.sh_offset, section.sh_size / sizeof(Dynamic))) {
      const std::string text = text_at(texts, entry.d_un.d_val);
      if (entry.d_tag == DT_NEEDED) file.needed.push_back(text);
      if (entry.d_tag == DT_RUNPATH || entry.d_tag == DT_RPATH) add_folders(text, file.folders);
    }
  }
}

}  // namespace

base::Result<LinkedFile> read_linked_file(const std::string& path) {
  if (auto file = expect_file(path); !file) return base::Error{file.error()};
  Parts parts(path);
  const auto ident = parts.read<char>(0, EI_NIDENT);
  if (ident.empty() || std::memcmp(ident.data(), ELFMAG, SELFMAG) != 0) {
    return base::Error{"'" + path + "' cannot be read as a program or shared library (ELF)"};
  }
  LinkedFile file;
  if (ident[EI_CLASS] == ELFCLASS64) {
    file.bits = 64;
    read_dynamic<Wide>(parts, file);
  } else {
    file.bits = 32;
    read_dynamic<Narrow>(parts, file);
  }
  return file;
}

}  // namespace armature::platform
