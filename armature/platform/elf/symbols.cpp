// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/symbols.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include <cxxabi.h>

namespace armature::platform {
namespace {

/// Reads on until `closing`, and makes long argument lists short.
std::string shortened_until(char closing, std::string_view& rest) {
  constexpr std::string_view kAllocator = ", std::allocator<";
  constexpr std::size_t kLongest = 72;
  std::string text;
  while (!rest.empty() && rest.front() != closing) {
    const char letter = rest.front();
    rest.remove_prefix(1);
    text += letter;
    const bool is_operator = text.size() > 8 && text.compare(text.size() - 9, 8, "operator") == 0;
    if (is_operator || (letter != '(' && letter != '<')) continue;
    const bool allocator = text.size() >= kAllocator.size() && text.ends_with(kAllocator);
    const char end = letter == '(' ? ')' : '>';
    const std::string inner = shortened_until(end, rest);
    if (!rest.empty()) rest.remove_prefix(1);
    if (allocator) {
      text.resize(text.size() - kAllocator.size());
    } else {
      text += (inner.size() > kLongest ? "..." : inner) + end;
    }
  }
  while (closing == '>' && text.ends_with(' ')) text.pop_back();
  return text;
}

}  // namespace

std::string shortened(std::string_view name) { return shortened_until('\0', name); }

std::string demangled(const char* name) {
  int status = 0;
  char* const text = abi::__cxa_demangle(name, nullptr, nullptr, &status);
  std::string result = text != nullptr ? text : name;
  std::free(text);
  return result;
}

Symbols::Symbols() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    Mapping mapping{};
    int path_at = 0;
    const int read =
        std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %*s %" SCNxPTR " %*s %*s %n",
                    &mapping.begin, &mapping.end, &mapping.offset, &path_at);
    if (read < 3 || path_at == 0 || line[static_cast<std::size_t>(path_at)] != '/') continue;
    mapping.file = line.substr(static_cast<std::size_t>(path_at));
    mappings_.push_back(std::move(mapping));
  }
}

Symbols::Function Symbols::at(const void* return_address) {
  // A call may be the last instruction of a function: what it returns to is the next function's.
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(return_address) - 1;
  const auto found = std::find_if(
      mappings_.begin(), mappings_.end(),
      [address](const Mapping& each) { return address >= each.begin && address < each.end; });
  if (found == mappings_.end()) return {{}, "unknown code"};
  const File& content = file(found->file);
  const std::uintptr_t in_file = content.address_of(address - found->begin + found->offset);
  char offset[24];
  std::snprintf(offset, sizeof offset, "+0x%" PRIxPTR, in_file);
  const char* const name = content.function_at(in_file);
  return {name == nullptr ? std::string() : shortened(demangled(name)),
          found->file.substr(found->file.rfind('/') + 1) + offset};
}

const Symbols::File& Symbols::file(const std::string& path) {
  const auto known = files_.find(path);
  return known != files_.end() ? known->second : files_.try_emplace(path, path).first->second;
}

Symbols::File::File(const std::string& path) : elf_(path) {
  for (const auto& section : elf_.sections()) {
    const bool has_symbols = section.sh_type == SHT_SYMTAB || section.sh_type == SHT_DYNSYM;
    if (!has_symbols || section.sh_link >= elf_.sections().size()) continue;
    const std::size_t names = elf_.sections()[section.sh_link].sh_offset;
    for (const auto& symbol : elf_.symbols(section)) {
      if (ELF64_ST_TYPE(symbol.st_info) != STT_FUNC || symbol.st_value == 0) continue;
      functions_.push_back({symbol.st_value, symbol.st_size, elf_.text(names + symbol.st_name)});
    }
  }
  std::stable_sort(functions_.begin(), functions_.end(),
                   [](const Symbol& a, const Symbol& b) { return a.begin < b.begin; });
}

std::uintptr_t Symbols::File::address_of(std::uintptr_t offset) const {
  for (const auto& segment : elf_.segments()) {
    const bool inside = segment.p_type == PT_LOAD && offset >= segment.p_offset &&
                        offset - segment.p_offset < segment.p_filesz;
    if (inside) return offset - segment.p_offset + segment.p_vaddr;
  }
  return offset;
}

const char* Symbols::File::function_at(std::uintptr_t address) const {
  const auto after = std::upper_bound(
      functions_.begin(), functions_.end(), address,
      [](std::uintptr_t wanted, const Symbol& each) { return wanted < each.begin; });
  if (after == functions_.begin()) return nullptr;
  const Symbol& last = *std::prev(after);
  return address < last.begin + std::max<std::uintptr_t>(last.size, 1) ? last.name : nullptr;
}

}  // namespace armature::platform
